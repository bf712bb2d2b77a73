// The recipe's types, its defaults and the graph of stages, from what `voxtet schema` says: src/engine/schema.json.
// `node generate_contract.mjs` writes src/engine/generated.ts; a test compares.
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const folder = new URL('src/engine/', import.meta.url);

const simpleTypes = {
  number: 'number',
  integer: 'number',
  boolean: 'boolean',
  string: 'string',
  vec3: 'Vec3',
  labels: 'number[]',
  label_groups: 'number[][]',
  names: 'string[]',
};

/** Fields by their paths -> objects in objects; a field is a leaf. */
function treeOf(fields) {
  const root = new Map();
  for (const field of fields) {
    const names = field.path.split('.');
    let place = root;
    for (const name of names.slice(0, -1)) {
      if (!place.has(name)) place.set(name, new Map());
      place = place.get(name);
    }
    place.set(names.at(-1), field);
  }
  return root;
}

const sentence = ({ description, unit }) =>
  `/** ${description.replace(/\.$/, '')}${unit ? `; ${unit}` : ''}. */`;

function typeOf(node, path, optional, indent) {
  if (!(node instanceof Map)) {
    if (node.type === 'enum') return node.values.map((value) => `'${value}'`).join(' | ');
    if (node.type === 'list') return `${typeOf(treeOf(node.items), `${path}[]`, optional, indent)}[]`;
    return simpleTypes[node.type];
  }
  const inner = `${indent}  `;
  const lines = [...node].flatMap(([name, child]) => {
    const own = path ? `${path}.${name}` : name;
    const mark = optional.has(own) ? '?' : '';
    const line = `${inner}${name}${mark}: ${typeOf(child, own, optional, inner)};`;
    return child instanceof Map ? [line] : [inner + sentence(child), line];
  });
  return `{\n${lines.join('\n')}\n${indent}}`;
}

function defaultsOf(node, path, optional) {
  if (!(node instanceof Map)) return node.default;
  const present = [...node].map(([name, child]) => [name, child, path ? `${path}.${name}` : name]);
  return Object.fromEntries(
    present
      .filter(([, , own]) => !optional.has(own))
      .map(([name, child, own]) => [name, defaultsOf(child, own, optional)]),
  );
}

const constant = (name, value) => `export const ${name} = ${JSON.stringify(value, null, 2)} as const;\n`;

export function generate(schema) {
  const optional = new Set(schema.optional_groups);
  const root = treeOf(schema.fields);
  const groups = Object.fromEntries(
    schema.optional_groups.map((path) => {
      const node = path.split('.').reduce((place, name) => place.get(name), root);
      return [path, defaultsOf(node, path, optional)];
    }),
  );
  return [
    '// Made from schema.json by generate_contract.mjs.\n',
    'export type Vec3 = [number, number, number];\n',
    `/** Every field of the recipe, as the engine declares them. */\nexport interface RecipeFields ${typeOf(root, '', optional, '')}\n`,
    `/** The recipe before anybody has changed it. */\n${constant('recipeDefaults', defaultsOf(root, '', optional))}`,
    `/** Groups that a recipe need not have, as they are at first. */\n${constant('optionalDefaults', groups)}`,
    `/** What each stage is made from: stages before it, and fields of the recipe. */\n${constant(
      'stageSpecs',
      schema.stages.map(({ name, inputs, reads }) => ({ name, inputs, reads })),
    )}`,
    `/** The stages that the app shows; the others run by themselves before those that need them. */\n${constant(
      'stageNames',
      schema.stages.filter(({ shown }) => shown).map(({ name }) => name),
    )}`,
  ].join('\n');
}

export const committedSchema = () => JSON.parse(readFileSync(new URL('schema.json', folder), 'utf8'));
export const generatedFile = new URL('generated.ts', folder);

if (import.meta.url === pathToFileURL(process.argv[1]).href)
  writeFileSync(generatedFile, generate(committedSchema()));
