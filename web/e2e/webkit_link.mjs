#!/usr/bin/env node
/**
 * Opens an example's link in WebKitGTK, which has Safari's engines, presses Open and run, and prints what became of its
 * promise: xvfb-run -a node e2e/webkit_link.mjs [EXAMPLE] [--offline] [--picture FILE.png]. With --offline once more
 * without the host.
 */
import { spawn } from 'node:child_process';
import { readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { serve } from '../serve.mjs';

const web = join(dirname(fileURLToPath(import.meta.url)), '..');
// The driver takes no port that was in use a minute ago.
const port = 20_000 + (process.pid % 20_000);
const browser = process.env.MINIBROWSER ?? '/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser';
const { values, positionals } = parseArgs({
  options: { offline: { type: 'boolean' }, picture: { type: 'string' } },
  allowPositionals: true,
});
const [example = 'wall-layers'] = positionals;

async function ask(path, body, method = 'POST') {
  const response = await fetch(`http://127.0.0.1:${port}${path}`, {
    method,
    body: body && JSON.stringify(body),
  });
  const { value } = await response.json();
  if (!response.ok) throw new Error(`${path}: ${value.error}: ${value.message}`);
  return value;
}

async function eventually(what, attempt, seconds = 120) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const found = await attempt();
    if (found) return found;
    if (Date.now() > end) throw new Error(`${what} did not come within ${seconds} s.`);
    await new Promise((waited) => setTimeout(waited, 200));
  }
}

async function linkOf(folder) {
  const read = async (name) => JSON.parse(await readFile(join(web, '../examples', folder, name), 'utf8'));
  const { engine, digest, tets } = await read('expected.json');
  const recipe = { ...(await read('case.json')), expected: { engine, digest, tets } };
  return `#j=${encodeURIComponent(JSON.stringify(recipe))}`;
}

const server = await serve({ root: join(web, 'dist'), port: 0 });
// A system without a language has none that JavaScript knows; most machines that run this have no graphics card.
const env = { ...process.env, LANG: 'en_US.UTF-8', LANGUAGE: 'en_US', LIBGL_ALWAYS_SOFTWARE: '1' };
const driver = spawn('WebKitWebDriver', [`--port=${port}`], { stdio: 'ignore', env });
let session;
try {
  await eventually('the driver', () => ask('/status', undefined, 'GET').catch(() => null), 10);
  const options = { binary: browser, args: ['--automation'] };
  const opened = await ask('/session', {
    capabilities: { alwaysMatch: { 'webkitgtk:browserOptions': options } },
  });
  session = `/session/${opened.sessionId}`;
  const { browserName, browserVersion } = opened.capabilities;
  console.log(`${browserName} ${browserVersion}`);
  const run = (script) => ask(`${session}/execute/sync`, { script, args: [] });
  const press = (name) =>
    eventually(name, () =>
      run(`const button = [...document.querySelectorAll('button')].find((one) => one.innerText.trim() === '${name}');
        if (!button || button.disabled) return false;
        button.click();
        return true;`),
    );
  const tell = async () => {
    const verdict = await eventually('the verdict', () =>
      run(`return document.querySelector('[data-testid=verdict]')?.innerText`),
    );
    const threads = await run(`return crossOriginIsolated && 'SharedArrayBuffer' in window`);
    console.log(`${threads ? 'threads' : 'one thread'}: ${verdict.replace(/\s+/g, ' ')}`);
    const told = await run(
      `return [...document.querySelectorAll('.notice')].map((one) => one.innerText).join()`,
    );
    if (told) console.log(`told: ${told}`);
  };
  const { port: at } = server.address();
  await ask(`${session}/url`, { url: `http://127.0.0.1:${at}/${await linkOf(example)}` });
  await press('Open and run');
  await tell();
  if (values.picture) {
    // Time to draw.
    await new Promise((waited) => setTimeout(waited, 3000));
    const png = await ask(`${session}/screenshot`, undefined, 'GET');
    await writeFile(values.picture, Buffer.from(png, 'base64'));
  }
  if (values.offline) {
    await eventually('the offline copy', () =>
      run(`return navigator.serviceWorker.controller?.state === 'activated'`),
    );
    server.close();
    server.closeAllConnections();
    await ask(`${session}/refresh`, {});
    await press('Run');
    await tell();
  }
} finally {
  if (session) await ask(session, undefined, 'DELETE').catch(() => undefined);
  driver.kill();
  server.close();
  server.closeAllConnections();
}
