/** Values of the engine's own, for groups and list items that a recipe does not have yet. */
import type { SchemaField } from '../../engine/contract';
import { schema } from './stages';

/** Sets a value by its path, "anatomy.wall", in nested objects. */
function put(target: Record<string, unknown>, path: string, value: unknown): void {
  const [first, ...rest] = path.split('.');
  if (rest.length === 0) target[first] = structuredClone(value);
  else put((target[first] ??= {}) as Record<string, unknown>, rest.join('.'), value);
}

function defaultsOf(fields: readonly SchemaField[], isLeftOut: (path: string) => boolean): unknown {
  const values: Record<string, unknown> = {};
  for (const { path, type, default: value } of fields)
    if (!isLeftOut(path)) put(values, path, type === 'list' ? [] : value);
  return values;
}

/** A group with every field at its default, without the optional groups within it. */
export function groupDefaults<T>(group: string): T {
  const { fields = [], optional_groups: optional = [] } = schema.value ?? {};
  const within = `${group}.`;
  const inner = optional.filter((path) => path.startsWith(within)).map((path) => path.slice(within.length));
  const own = fields
    .filter(({ path }) => path.startsWith(within))
    .map((field) => ({ ...field, path: field.path.slice(within.length) }));
  return defaultsOf(own, (path) => inner.some((name) => path.startsWith(`${name}.`))) as T;
}

/** An item of a list with every field at its default. */
export function itemDefaults<T>(list: string): T {
  const field = schema.value?.fields.find(({ path }) => path === list);
  return defaultsOf(field?.items ?? [], () => false) as T;
}
