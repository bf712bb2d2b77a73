#!/usr/bin/env -S node --experimental-websocket
/**
 * Opens the link of every example in the browsers of others, each in a fresh profile, and runs it: xvfb-run -a node
 * --experimental-websocket e2e/browsers/example_links.mjs [--browsers chromium,firefox,webkit] [--examples NAME,NAME].
 * Prints a line for each: the length of the link, the digest that the command line promises, and the verdict of each
 * browser. Ends with 1 where one is not "reproduced". By hand: it takes minutes, and Firefox and WebKit are not among the
 * packages of scripts/setup (apt-get install firefox-esr webkit2gtk-driver xvfb; only WebKit wants xvfb-run).
 */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { serve } from '../../serve.mjs';
import { openChromium } from './chromium.mjs';
import { openFirefox } from './firefox.mjs';
import { openWebKit } from './webkit.mjs';

const openers = { chromium: openChromium, firefox: openFirefox, webkit: openWebKit };
const root = fileURLToPath(new URL('../../../', import.meta.url));
const option = (name, all) => {
  const at = process.argv.indexOf(`--${name}`);
  return at > 0 ? process.argv[at + 1].split(',') : all;
};
const read = (...path) => JSON.parse(readFileSync(join(root, 'examples', ...path), 'utf8'));

function fragmentOf(name) {
  const { engine, digest, tets, stages } = read(name, 'expected.json');
  const expected = { engine, digest, tets, ...(stages && { stages }) };
  const text = JSON.stringify({ ...read(name, 'case.json'), expected });
  return { digest, fragment: `#c1=${deflateRawSync(text, { level: 9 }).toString('base64url')}` };
}

/** What an expression gives as soon as it gives something. */
async function until(browser, expression, seconds) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; ) {
    const found = await browser.evaluate(expression);
    if (found) return found;
    await new Promise((later) => setTimeout(later, 300));
  }
  throw new Error(`nothing within ${seconds} s of: ${expression}`);
}

const press = (words) =>
  `(() => { const all = [...document.querySelectorAll('button')];
    const one = all.find((b) => b.textContent.trim() === '${words}' && !b.disabled); one?.click(); return !!one; })()`;
const verdict = `document.querySelector('[data-testid=verdict]')?.className.replace('verdict ', '') ?? ''`;
const awaited = `document.querySelector('[data-testid=verdict]')?.textContent.includes('Simulate it') ?? false`;

/** 'reproduced' and so on, of the mesh and of all that is simulated on it. */
async function verdictIn(browser, address) {
  await browser.goto('about:blank');
  await browser.goto(address);
  await until(browser, press('Open and run'), 60);
  await until(browser, verdict, 300);
  if (await browser.evaluate(awaited)) {
    await until(browser, press('Simulate it'), 60);
    await until(browser, `!${awaited}`, 600);
  }
  return browser.evaluate(verdict);
}

const names = option(
  'examples',
  readdirSync(join(root, 'examples')).filter((name) => existsSync(join(root, 'examples', name, 'case.json'))),
);
const server = await serve({ root: join(root, 'web/dist'), port: 0 });
const base = `http://127.0.0.1:${server.address().port}/`;
let failed = false;
for (const key of option('browsers', Object.keys(openers))) {
  for (const name of names) {
    const { digest, fragment } = fragmentOf(name);
    const browser = await openers[key]();
    const begin = performance.now();
    const found = await verdictIn(browser, base + fragment).catch((error) => error.message);
    const seconds = ((performance.now() - begin) / 1000).toFixed(1);
    failed ||= found !== 'reproduced';
    console.log(
      `${browser.name}\t${name}\t${fragment.length} characters\t${digest.slice(0, 12)}\t${found}\t${seconds} s`,
    );
    await browser.close();
  }
}
server.close();
process.exit(failed ? 1 : 0);
