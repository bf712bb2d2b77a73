/**
 * What pages take from the tree, so that it is written once. A line of a page that begins with @ is an insert:
 *
 *   @recipe, @presets, @stages   fields of a case, presets, stages, from the engine's schema
 *   @help                        what `voxtet --help` says, from help.txt
 *   @bibtex                      how to cite
 *   @table FILE [TEXT]           of a README the first table that ends behind this text
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { citation } from '../../web/src/report/citation';
import { helpPages } from './help_pages';
import { presets, recipeReference, stages } from './recipe_reference';

/** Without its links, which lead from another place. */
export function tableOf(markdown: string, after: string): string {
  const from = markdown.indexOf(after);
  const tables = [...markdown.matchAll(/(?:^\|.*\n)+/gm)];
  const table = tables.find(({ index, 0: text }) => index + text.length > from);
  if (from < 0 || !table) throw new Error(`no table after "${after}"`);
  return table[0].replaceAll(/\[([^\]]*)\]\([^)]*\)/g, '$1');
}

export function withInserts(markdown: string, root: string): string {
  const read = (file: string) => readFileSync(join(root, file), 'utf8');
  const schema = () => JSON.parse(read('web/src/engine/schema.json'));
  const inserts: Record<string, (file: string, text: string) => string> = {
    recipe: () => recipeReference(schema()),
    presets: () => presets(schema()),
    stages: () => stages(schema()),
    help: () => helpPages(read('docs/help.txt')),
    bibtex: () => `\`\`\`\n${citation(JSON.parse(read('web/package.json')).version)}\`\`\`\n`,
    table: (file, text = '') => tableOf(read(file), text),
  };
  return markdown.replaceAll(/^@(\w+)(?: (\S+))?(?: (.+))?$/gm, (_, name: string, file, text) => {
    if (!(name in inserts)) throw new Error(`no insert is called @${name}`);
    return inserts[name](file, text);
  });
}
