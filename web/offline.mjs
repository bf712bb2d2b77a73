/** Writes sw.js into a built app: service_worker.js, and the list of what it keeps for use without a network. */
import { createHash } from 'node:crypto';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

/** Grows after the build (keep_engines.mjs), and is kept as it is found. */
const growing = 'engines.json';
/** Compressed copies, the documentation, and what is large and for few: that is kept from its first use on. */
const left = /\.(br|gz)$|^sw\.js$|^docs\/|^assets\/dicom-|\/voxtet_verification\./;

export async function writeServiceWorker(folder) {
  const names = await readdir(folder, { recursive: true, withFileTypes: true });
  const paths = names
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name).slice(resolve(folder).length + 1))
    .filter((path) => !left.test(path))
    .sort();
  const files = {};
  for (const path of paths) {
    const digest = createHash('sha256').update(await readFile(join(folder, path)));
    files[path] = path === growing ? '' : `sha256-${digest.digest('base64')}`;
  }
  const list = JSON.stringify(files, null, 1);
  const version = createHash('sha256').update(list).digest('hex').slice(0, 8);
  const worker = await readFile(join(here, 'service_worker.js'), 'utf8');
  await writeFile(join(folder, 'sw.js'), `const version = '${version}';\nconst files = ${list};\n${worker}`);
}
