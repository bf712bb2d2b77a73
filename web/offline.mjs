#!/usr/bin/env node
/** Writes sw.js into a built app: service_worker.js and what it keeps for use without a network. node offline.mjs [dist]. */
import { createHash } from 'node:crypto';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

/** What the app is made of. Its documentation, source and compressed copies are not among it. */
const kept = /^(\w+\.html|icon[\w-]*\.\w+|\w+\.webmanifest|gallery\/.*|assets\/.*)$/;
/** Large, and for few: kept from its first use on. */
const onFirstUse = /\.(br|gz)$|^assets\/dicom-|\/voxtet_verification\./;

export async function writeServiceWorker(folder) {
  const names = await readdir(folder, { recursive: true, withFileTypes: true });
  const paths = names
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name).slice(resolve(folder).length + 1))
    .filter((path) => kept.test(path) && !onFirstUse.test(path))
    .sort();
  const files = {};
  for (const path of paths) {
    const digest = createHash('sha256').update(await readFile(join(folder, path)));
    files[path] = `sha256-${digest.digest('base64')}`;
  }
  const list = JSON.stringify(files, null, 1);
  const version = createHash('sha256').update(list).digest('hex').slice(0, 8);
  const worker = await readFile(join(here, 'service_worker.js'), 'utf8');
  await writeFile(join(folder, 'sw.js'), `const version = '${version}';\nconst files = ${list};\n${worker}`);
  return paths;
}

if (process.argv[1] && import.meta.url === pathToFileURL(resolve(process.argv[1])).href) {
  const paths = await writeServiceWorker(resolve(here, process.argv[2] ?? 'dist'));
  console.log(`${paths.length} files are kept for use without a network`);
}
