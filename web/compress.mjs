#!/usr/bin/env node
/** Writes .br and .gz beside each file of a built app that gets smaller by it: node compress.mjs [dist]. */
import { createHash } from 'node:crypto';
import { existsSync } from 'node:fs';
import { mkdir, readdir, readFile, rename, rm, writeFile } from 'node:fs/promises';
import { dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { brotliCompress, constants, gzip } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const minBytes = 1000;
/** What is not compressed already. */
const kinds = new Set(['.html', '.js', '.mjs', '.css', '.svg', '.txt', '.json', '.wasm']);

/** By the ending of the file, which serve.mjs and servers of static files know. */
const encoders = {
  br: (bytes) =>
    promisify(brotliCompress)(bytes, {
      params: {
        [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY,
        [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS,
        [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
      },
    }),
  gz: (bytes) => promisify(gzip)(bytes, { level: constants.Z_BEST_COMPRESSION }),
};

/** The engine takes a while and rarely changes: what is large is kept by the digest of its bytes. */
const keptBytes = 1_000_000;
const kept = join(here, 'node_modules/.cache/compressed');

async function compressed(bytes, ending, used) {
  if (bytes.length < keptBytes) return encoders[ending](bytes);
  const name = `${createHash('sha256').update(bytes).digest('hex')}.${ending}`;
  const path = join(kept, name);
  used.add(name);
  if (existsSync(path)) return readFile(path);
  const small = await encoders[ending](bytes);
  const part = `${path}.${process.pid}`;
  await writeFile(part, small);
  await rename(part, path);
  return small;
}

/** Sums of bytes: of what is worth it, and of what it becomes. */
export async function compressFolder(folder) {
  await mkdir(kept, { recursive: true });
  const used = new Set();
  const sums = { plain: 0, br: 0, gz: 0 };
  const names = await readdir(folder, { recursive: true });
  await Promise.all(
    names
      .filter((name) => kinds.has(extname(name)))
      .map(async (name) => {
        const bytes = await readFile(join(folder, name));
        if (bytes.length < minBytes) return;
        sums.plain += bytes.length;
        for (const ending of Object.keys(encoders)) {
          const small = await compressed(bytes, ending, used);
          sums[ending] += small.length;
          await writeFile(join(folder, `${name}.${ending}`), small);
        }
      }),
  );
  if (used.size > 0) for (const name of await readdir(kept)) if (!used.has(name)) await rm(join(kept, name));
  return sums;
}

if (process.argv[1] && import.meta.url === pathToFileURL(resolve(process.argv[1])).href) {
  const { plain, br, gz } = await compressFolder(resolve(here, process.argv[2] ?? 'dist'));
  const kB = (bytes) => `${Math.round(bytes / 1000).toLocaleString('en')} kB`;
  console.log(`${kB(plain)}: ${kB(br)} as brotli, ${kB(gz)} as gzip`);
}
