/** The recipe's fields, presets and stages as Markdown, from what `voxtet schema` says. */
import { choiceWords, fieldWords, groupWords } from '../../web/src/panels/controls/field_words';

export interface Field {
  path: string;
  type: string;
  default: unknown;
  description: string;
  unit?: string;
  min?: number;
  max?: number;
  values?: string[];
  items?: Field[];
}

export interface Schema {
  fields: Field[];
  optional_groups: string[];
  presets: Record<string, Record<string, object>>;
  stages: { name: string; title: string; inputs: string[]; reads: string[] }[];
}

const typeWords: Record<string, string> = {
  vec3: 'three numbers',
  labels: 'list of labels',
  label_groups: 'list of lists of labels',
  names: 'list of texts',
  string: 'text',
  boolean: 'true or false',
  list: 'list of objects',
};
const unitWords: Record<string, string> = { deg: '°', voxel: 'voxels' };
const large = 1e9;

const code = (value: unknown) => `\`${JSON.stringify(value)}\``;
const cell = (text: string) => text.replaceAll('|', '\\|').replaceAll('<', '&lt;');

function boundsOf({ min, max }: Field): string {
  const [low, high] = [min ?? -large, max ?? large].map((bound) =>
    bound.toLocaleString('en', { maximumFractionDigits: 9 }),
  );
  if (Math.abs(min ?? large) >= large) return Math.abs(max ?? large) >= large ? '' : `up to ${high}`;
  return (max ?? large) >= large ? `${low} or more` : `${low} to ${high}`;
}

/** What may stand there. */
export function typeOf(field: Field): string {
  const { type, values, unit } = field;
  const kind = values ? values.map((value) => `\`${value}\``).join(', ') : (typeWords[type] ?? type);
  return [kind, unit ? (unitWords[unit] ?? unit) : '', boundsOf(field)].filter(Boolean).join('; ');
}

/** What the app calls it, where that is not its name said in words. */
function wordsOf(path: string, values: string[] = []): string {
  const own = fieldWords(path);
  const plain = path.slice(path.lastIndexOf('.') + 1).replaceAll('_', ' ');
  const named = plain.toLowerCase().startsWith(own.toLowerCase()) ? [] : [`“${own}”`];
  const choices = values
    .filter((value) => choiceWords(path, value) !== value.replaceAll('_', ' '))
    .map((value) => `\`${value}\`: “${choiceWords(path, value)}”`);
  const all = [...named, ...choices];
  return all.length > 0 ? ` In the app: ${all.join(', ')}.` : '';
}

function rowsOf(fields: Field[], prefix: string): string[] {
  return fields.flatMap((field) => {
    const path = prefix + field.path;
    const meaning = field.description.replace(/\.?$/, '.') + wordsOf(path.replaceAll('[]', ''), field.values);
    const value = field.type === 'list' && field.items ? '`[]`' : code(field.default);
    return [
      `| <code id="${path.replaceAll('[]', '')}">${path}</code><br>${cell(typeOf(field))} | ${cell(meaning)}<br>Default: ${value} |`,
      ...rowsOf(field.items ?? [], `${path}[].`),
    ];
  });
}

export function recipeReference({ fields, optional_groups }: Schema): string {
  const groups = [...new Set(fields.map(({ path }) => path.split('.')[0]))];
  const sections = groups.map((group) => {
    const own = fields.filter(({ path }) => path === group || path.startsWith(`${group}.`));
    const optional = optional_groups.filter((one) => one === group || one.startsWith(`${group}.`));
    const note =
      optional.length > 0
        ? `A case need not have ${optional.map((one) => `\`${one}\``).join(', ')}; the defaults are those that a group has once it is there.\n\n`
        : '';
    const words = groupWords[group];
    const title = words && words.toLowerCase() !== group ? `In the app: “${words}”.\n\n` : '';
    return `## ${group}\n\n${title}${note}| field | meaning |\n|---|---|\n${rowsOf(own, '').join('\n')}\n`;
  });
  return sections.join('\n');
}

/** Which fields a preset sets, and to what. */
export function presets(schema: Schema): string {
  const rows = Object.entries(schema.presets).map(([name, groups]) => {
    const fields = Object.entries(groups).flatMap(([group, values]) =>
      Object.entries(values).map(([field, value]) => `\`${group}.${field}\` ${value}`),
    );
    return `| ${name.replaceAll('_', ' ')} | ${fields.join(', ')} |`;
  });
  return ['| preset | sets |', '|---|---|', ...rows, ''].join('\n');
}

export function stages(schema: Schema): string {
  const titles = new Map(schema.stages.map(({ name, title }) => [name, title]));
  const rows = schema.stages.map(({ name, title, inputs, reads }) => {
    const from = inputs.map((one) => titles.get(one)!.toLowerCase()).join(', ');
    return `| ${title} | \`${name}\` | ${from || 'the file'} | ${reads.map((one) => `\`${one}\``).join(', ')} |`;
  });
  return ['| stage | name | made from | fields that it reads |', '|---|---|---|---|', ...rows, ''].join('\n');
}
