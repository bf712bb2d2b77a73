#!/usr/bin/env node
/** Every link and picture of the built pages leads to a file of the built app, and to a place that is in it. */
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const site = fileURLToPath(new URL('../web/dist/', import.meta.url));

/** What is wrong with the pages below a folder of the site. */
export function deadLinks(root, folder) {
  const pages = readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' })
    .filter((name) => name.endsWith('.html'))
    .map((name) => join(folder, name));
  const faults = [];
  const textOf = (path) => readFileSync(join(root, path), 'utf8');
  for (const page of pages)
    for (const [, link] of textOf(page).matchAll(/<[^>]* (?:href|src)="([^"]*)"/g)) {
      const { protocol, pathname, hash } = new URL(link.replaceAll('&amp;', '&'), `site:/${page}`);
      if (protocol !== 'site:') continue;
      let path = decodeURIComponent(pathname).slice(1);
      if (path === '' || path.endsWith('/')) path += 'index.html';
      const file = join(root, path);
      if (!existsSync(file) || !statSync(file).isFile()) faults.push(`${page}: ${link} leads nowhere`);
      else if (hash && !textOf(path).includes(` id="${decodeURIComponent(hash.slice(1))}"`))
        faults.push(`${page}: ${link}: ${path} has no such place`);
    }
  return faults;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const faults = deadLinks(site, 'docs');
  for (const fault of faults) console.error(fault);
  process.exitCode = faults.length > 0 ? 1 : 0;
}
