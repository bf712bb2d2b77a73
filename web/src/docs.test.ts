/** What the documentation makes of the tree; how its pages find their address and each other. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { base, relativePage, relativeScript } from '../../docs/.vitepress/any_address';
import { helpPages, parseHelp } from '../../docs/.vitepress/help_pages';
import { tableOf, withInserts } from '../../docs/.vitepress/inserts';
import { recipeReference, typeOf, type Field, type Schema } from '../../docs/.vitepress/recipe_reference';
import { deadLinks } from '../../docs/check_links.mjs';
import { committedSchema } from '../generate_contract.mjs';

const help = readFileSync(new URL('../../docs/help.txt', import.meta.url), 'utf8');

describe('the reference of the recipe', () => {
  const schema = committedSchema() as Schema;
  const page = recipeReference(schema);

  function promise(field: Field, prefix: string): void {
    const path = `${prefix}${field.path}`;
    const row = page.split('\n').find((line) => line.includes(`>${path}</code>`));
    expect(row, path).toBeDefined();
    expect(row).toContain(field.description.replace(/\.$/, ''));
    for (const value of field.values ?? []) expect(row).toContain(`\`${value}\``);
    if (field.type !== 'list') expect(row).toContain(`Default: \`${JSON.stringify(field.default)}\``);
    if (field.unit && field.unit !== 'deg') expect(row).toContain(field.unit);
    for (const item of field.items ?? []) promise(item, `${path}[].`);
  }

  it('has every field with its meaning, default, unit and choices', () => {
    for (const field of schema.fields) promise(field, '');
  });

  it('says bounds as they are, and none where there are none', () => {
    const field = { path: 'x', type: 'number', default: 1, description: 'X.' };
    expect(typeOf({ ...field, min: 0.01, max: 1000, unit: 'mm' })).toBe('number; mm; 0.01 to 1,000');
    expect(typeOf({ ...field, min: 0, max: 1e9 })).toBe('number; 0 or more');
    expect(typeOf(field)).toBe('number');
  });
});

describe('the pages of the command line', () => {
  it('have each option with what it does', () => {
    const commands = parseHelp(help);
    expect(commands.length).toBeGreaterThan(9);
    for (const { name, purpose, usage, options } of commands) {
      expect(usage).toBe(usage.trim());
      expect(usage).toContain(`voxtet ${name}`);
      expect(purpose).not.toBe('');
      expect(options[0]).toBeDefined();
      // Only files that are named by their place need no word.
      for (const option of options.filter(({ name: words }) => words.startsWith('-')))
        expect(option.meaning, option.name).toMatch(/\w/);
    }
    const mesh = commands.find(({ name }) => name === 'mesh')!;
    expect(mesh.options.find(({ name }) => name.startsWith('--transfer'))).toEqual({
      name: '--transfer,--look-up LABELS',
      meaning: 'labels to transfer to the tetrahedra, as 5,6',
    });
  });

  it('tell options that two commands have alike once, and where', () => {
    const page = helpPages(help);
    expect(page.match(/\| `--edge-mm LENGTH` \|/g)).toHaveLength(1);
    expect(page).toMatch(/As for \[`mesh`\]\(#mesh\): .*`--edge-mm`/);
  });
});

describe('inserts', () => {
  const readme = 'One\n\n| a | b |\n|---|---|\n| 1 | [x](y.md) |\n\n## Two\n\n| c |\n|---|\n';

  it('take the table behind a text, without its links', () => {
    expect(tableOf(readme, '')).toBe('| a | b |\n|---|---|\n| 1 | x |\n');
    expect(tableOf(readme, '## Two')).toBe('| c |\n|---|\n');
    expect(tableOf(readme, '| c |')).toBe('| c |\n|---|\n');
    expect(() => tableOf(readme, 'Three')).toThrow('no table after "Three"');
  });

  it('refuse what is not known', () => {
    expect(() => withInserts('@nothing', '')).toThrow('no insert is called @nothing');
    expect(withInserts('me@home.org\n', '')).toBe('me@home.org\n');
  });
});

describe('pages at any address', () => {
  it('lead to each other from where they are, and hold no script and no style', () => {
    const page = relativePage(
      `<p style="top:0"><a href="${base}start.html"></a><script id="one">go()</script>`,
      'a/b.md',
    );
    expect(page).toMatch(
      /^<p><a href="\.\.\/start\.html"><\/a><script src="\.\.\/assets\/one\.\w{8}\.js"><\/script>$/,
    );
    expect(relativePage(`<a href="${base}">`, 'index.md')).toBe('<a href="./">');
  });

  it('have scripts that find it in every text, whatever stands around it', () => {
    const inner = JSON.stringify(JSON.stringify({ base, name: 'it\'s "so"' }));
    const code = `const x = "1"; [\`${base}a/\${x}.js\`, "${base}", JSON.parse(${inner}).base, '{"id":"${base}b"}']`;
    const found = new Function(
      'docsBase',
      `return (() => { ${relativeScript(code).replace('[', 'return [')} })()`,
    );
    expect(found('/sub/docs/')).toEqual([
      '/sub/docs/a/1.js',
      '/sub/docs/',
      '/sub/docs/',
      '{"id":"/sub/docs/b"}',
    ]);
  });
});

describe('dead links', () => {
  it('are found: pages, pictures and places that are not there', () => {
    const site = mkdtempSync(join(tmpdir(), 'site-'));
    mkdirSync(join(site, 'docs/a'), { recursive: true });
    writeFileSync(join(site, 'index.html'), '');
    writeFileSync(join(site, 'docs/index.html'), '<h2 id="here"></h2><a href="https://elsewhere.org/">');
    const links = ['../', '../index.html#here', '../../', 'c.html', '../index.html#there'];
    const page = links.map((link) => `<a class="x" href="${link}">`).join('');
    writeFileSync(join(site, 'docs/a/b.html'), `${page}<img src="p.png">`);
    expect(deadLinks(site, 'docs')).toEqual([
      'docs/a/b.html: c.html leads nowhere',
      'docs/a/b.html: ../index.html#there: docs/index.html has no such place',
      'docs/a/b.html: p.png leads nowhere',
    ]);
    rmSync(site, { recursive: true });
  });
});
