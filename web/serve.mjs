#!/usr/bin/env node
/**
 * Serves the built app from this machine to this machine: node serve.mjs [--port 8123] [--dir dist] [--base /sub/path/]
 * [--headers none]. The last makes it as plain as a host can be: no isolation, no policy, no compressed files, nothing
 * said of caching, and types that an old host does not know.
 */
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { dirname, extname, join, resolve, sep } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.mjs': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.txt': 'text/plain; charset=utf-8',
  '.gz': 'application/gzip',
  '.json': 'application/json; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.webp': 'image/webp',
  '.wasm': 'application/wasm',
  '.woff2': 'font/woff2',
  '.webmanifest': 'application/manifest+json',
};
const newTypes = ['.wasm', '.webmanifest'];

// data: is how the reader of DICOM fetches the decompressor that it carries within itself.
const headers = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Resource-Policy': 'same-origin',
  'X-Content-Type-Options': 'nosniff',
  'Referrer-Policy': 'no-referrer',
  'Content-Security-Policy':
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; " +
    "font-src 'self'; connect-src 'self' data: https:; worker-src 'self'; object-src 'none'; base-uri 'none'; " +
    "form-action 'none'; frame-ancestors 'none'",
};

/** As a part of another page the app has one button, and fetches nothing: `?embed` may stand in any frame. */
function headersFor(requestUrl) {
  const embedded = /\?(.*&)?embed([=&]|$)/.test(requestUrl);
  if (!embedded) return headers;
  return {
    ...headers,
    'Cross-Origin-Resource-Policy': 'cross-origin',
    'Content-Security-Policy': headers['Content-Security-Policy'].replace("; frame-ancestors 'none'", ''),
  };
}

/** The file that a request below `base` means, or null: nothing outside `root` is ever named. */
export function fileOf(root, requestUrl, base = '/') {
  let path;
  try {
    path = decodeURIComponent(new URL(requestUrl, 'http://localhost').pathname);
  } catch {
    return null;
  }
  if (!path.startsWith(base) || path.includes('\0') || path.includes('\\')) return null;
  const file = resolve(root, `./${path.slice(base.length)}${path.endsWith('/') ? 'index.html' : ''}`);
  return file.startsWith(resolve(root) + sep) ? file : null;
}

/** Of `br` and `gzip` those that a browser takes, the smaller first; see compress.mjs. */
export function encodingsFor(accepted = '') {
  const asked = accepted.split(',').map((part) => part.trim().split(/\s*;\s*q=/));
  return ['br', 'gzip'].filter((name) => asked.some(([one, q]) => one === name && Number(q ?? 1) > 0));
}

const endings = { br: '.br', gzip: '.gz' };

/** The smallest of a file and of what was compressed of it, as far as a browser takes it; null where there is no file. */
async function foundAt(file, accepted) {
  const sizeOf = async (path) => {
    const found = await stat(path).catch(() => null);
    return found?.isFile() ? found : null;
  };
  const plain = await sizeOf(file);
  if (!plain) return null;
  for (const encoding of encodingsFor(accepted)) {
    const path = file + endings[encoding];
    const found = await sizeOf(path);
    if (found) return { path, encoding, size: found.size, changed: plain.mtimeMs };
  }
  return { path: file, encoding: null, size: plain.size, changed: plain.mtimeMs };
}

function typeOf(file, plain) {
  const ending = extname(file);
  return (!(plain && newTypes.includes(ending)) && types[ending]) || 'application/octet-stream';
}

export function serve({ root, port, base = '/', plain = false }) {
  const server = createServer(async (request, response) => {
    const answer = (status, text) =>
      response.writeHead(status, { ...(!plain && headers), 'Content-Type': 'text/plain' }).end(text);
    if (request.method !== 'GET' && request.method !== 'HEAD') return answer(405, 'Only GET.');
    const file = fileOf(root, request.url ?? '/', base);
    const found = file && (await foundAt(file, plain ? '' : request.headers['accept-encoding']));
    if (!found) return answer(404, 'Not here.');
    const { path, encoding, size, changed } = found;
    const tag = `"${Math.round(changed).toString(36)}-${size.toString(36)}"`;
    const common = !plain && {
      ...headersFor(request.url ?? '/'),
      ETag: tag,
      Vary: 'Accept-Encoding',
      // Hashed names never change; everything else is asked for again.
      'Cache-Control': file.includes(`${sep}assets${sep}`)
        ? 'public, max-age=31536000, immutable'
        : 'no-cache',
    };
    if (!plain && request.headers['if-none-match'] === tag) return response.writeHead(304, common).end();
    response.writeHead(200, {
      ...common,
      'Content-Type': typeOf(file, plain),
      'Content-Length': size,
      ...(encoding && { 'Content-Encoding': encoding }),
    });
    if (request.method === 'HEAD') return response.end();
    createReadStream(path)
      .on('error', () => response.destroy())
      .pipe(response);
  });
  return new Promise((listening, failed) => {
    server.once('error', failed);
    server.listen(port, '127.0.0.1', () => listening(server));
  });
}

export const sampleCase = {
  labels: [1, 2, 5, 6],
  sizing: {
    edge_mm: 4,
    labels: [
      { edge_mm: 2, label: 5 },
      { edge_mm: 2.5, label: 6 },
    ],
  },
  source: { phantom: { kind: 'biventricle', scar: true, spacing_mm: [2, 2, 2] } },
};

function option(name, fallback) {
  const at = process.argv.indexOf(`--${name}`);
  return at > 0 ? process.argv[at + 1] : fallback;
}

if (process.argv[1] && import.meta.url === pathToFileURL(resolve(process.argv[1])).href) {
  const root = resolve(here, option('dir', 'dist'));
  const port = Number(option('port', '8123'));
  const base = option('base', '/');
  if (!/^\/(.*\/)?$/.test(base)) {
    console.error(`--base ${base}: a path that begins and ends with / is expected.`);
    process.exit(1);
  }
  if (!(await stat(join(root, 'index.html')).catch(() => null))) {
    console.error(`No app in ${root}: build it first.`);
    process.exit(1);
  }
  try {
    await serve({ root, port, base, plain: option('headers') === 'none' });
    const address = `http://127.0.0.1:${port}${base}`;
    console.log(`voxtet: ${address}`);
    console.log(`sample heart: ${address}#j=${encodeURIComponent(JSON.stringify(sampleCase))}`);
  } catch (error) {
    console.error(
      error.code === 'EADDRINUSE' ? `Port ${port} is taken; choose another with --port.` : String(error),
    );
    process.exit(1);
  }
}
