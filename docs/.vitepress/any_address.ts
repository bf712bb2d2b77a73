/**
 * The built pages work under whatever address they are served, and run no script and no style that stands in a page: the
 * app's server allows files of its own origin only. VitePress wants to know its address beforehand, so it is told a word
 * that is found again in what it has made: in pages it becomes a relative address, in scripts what docs-base.js finds.
 */
import { createHash } from 'node:crypto';
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseAst } from 'vite';
import type { HeadConfig } from 'vitepress';

export const base = '/--docs--/';

/** The first script of each page. Its file lies in assets/. */
export const findBase: HeadConfig = [
  'script',
  { id: 'docs-base' },
  "window.docsBase = new URL('..', document.currentScript.src).pathname",
];

const scripts = new Map<string, string>();

/** A page: addresses relative to it, scripts as files, styles left to style.css. */
export function relativePage(html: string, page: string): string {
  const up = '../'.repeat(page.split('/').length - 1) || './';
  return html
    .replace(/<script id="([\w-]+)">([\s\S]*?)<\/script>/g, (_, name: string, code: string) => {
      const file = `assets/${name}.${createHash('sha256').update(code).digest('hex').slice(0, 8)}.js`;
      scripts.set(file, code);
      return `<script src="${base}${file}"></script>`;
    })
    .replace(/ style="[^"]*"/g, '')
    .replaceAll(base, up);
}

interface Node {
  type: string;
  start: number;
  end: number;
  value?: unknown;
}

/** A script in which each text with the word finds the address when it runs. */
export function relativeScript(code: string): string {
  const texts: Node[] = [];
  const collect = (node: Node) => {
    const text = node.type === 'Literal' || node.type === 'TemplateLiteral';
    if (text && code.slice(node.start, node.end).includes(base)) texts.push(node);
    else
      for (const child of Object.values(node).flat())
        if (child && typeof child === 'object' && 'type' in child) collect(child as Node);
  };
  if (code.includes(base)) collect(parseAst(code) as unknown as Node);
  return texts
    .sort((a, b) => b.start - a.start)
    .reduce(
      (all, { start, end }) =>
        `${all.slice(0, start)}(${all.slice(start, end)}).replaceAll("${base}",docsBase)${all.slice(end)}`,
      code,
    );
}

/** All that was written but the pages. */
export function finish(folder: string): void {
  rmSync(join(folder, '404.html')); // could not know where it is shown
  mkdirSync(join(folder, 'assets'), { recursive: true });
  for (const [file, code] of scripts) writeFileSync(join(folder, file), code);
  for (const name of readdirSync(folder, { recursive: true, encoding: 'utf8' })) {
    if (!/\.(js|css)$/.test(name)) continue;
    const text = readFileSync(join(folder, name), 'utf8');
    const done = name.endsWith('.css')
      ? text.replaceAll(`${base}assets/`, './').replaceAll(base, '../')
      : relativeScript(text);
    if (done !== text) writeFileSync(join(folder, name), done);
  }
}
