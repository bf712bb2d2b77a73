/** The built app on hosts as people have them, without a network, and over an update. */
import { cp, mkdtemp, readdir, readFile, rename, rm, writeFile } from 'node:fs/promises';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import type { Page } from '@playwright/test';
import { writeServiceWorker } from '../offline.mjs';
import { serve } from '../serve.mjs';
import { expect, idle, link, meshed, openAndRun, test as base } from './support';

interface Host {
  url: string;
  /** The folder that it serves. */
  root: string;
  /** Paths that it was asked for. */
  asked: string[];
  stop(): void;
}

/** The built app on a host of its own, below `path`, and as plain as a host can be. */
const test = base.extend<{ path: string; plain: boolean; host: Host }>({
  path: ['/', { option: true }],
  plain: [false, { option: true }],
  host: async ({ path, plain }, use) => {
    const folder = await mkdtemp(join(tmpdir(), 'voxtet-'));
    const root = join(folder, 'dist');
    await cp(resolve('dist'), root, { recursive: true });
    const server = await serve({ root, port: 0, base: path, plain });
    const asked: string[] = [];
    server.on('request', ({ url }: { url: string }) => asked.push(url));
    const { port } = server.address() as AddressInfo;
    const stop = () => {
      server.close();
      server.closeAllConnections();
    };
    await use({ url: `http://127.0.0.1:${port}${path}`, root, asked, stop });
    stop();
    await rm(folder, { recursive: true });
  },
  baseURL: async ({ host }, use) => use(host.url),
  serviceWorkers: 'allow',
});

async function example(folder = 'wall-layers'): Promise<object> {
  const read = async (name: string) =>
    JSON.parse(await readFile(resolve('../examples', folder, name), 'utf8'));
  const { engine, digest, tets } = await read('expected.json');
  return { ...(await read('case.json')), expected: { engine, digest, tets } };
}

/** The app's files are kept: all that is still asked of the host is whether there are newer ones. */
async function kept(page: Page): Promise<void> {
  await page.waitForFunction(() => navigator.serviceWorker.controller?.state === 'activated');
}

const reproduced = (page: Page) => expect(page.getByTestId('verdict')).toContainText('Reproduced');
const isolated = (page: Page) => page.evaluate(() => crossOriginIsolated);

test.describe('below a path', () => {
  test.use({ path: '/some/path/' });

  test('a link gives the mesh that it promises', async ({ page, host }) => {
    await openAndRun(page, await example());
    await reproduced(page);
    expect(await isolated(page)).toBe(true);
    await kept(page);
    expect(host.asked.filter((path) => !path.startsWith('/some/path/'))).toEqual([]);
  });
});

test.describe('on a host that sends no headers', () => {
  test.use({ path: '/some/path/', plain: true });

  test('a link gives the mesh that it promises, and again without a network, with threads', async ({
    page,
    host,
  }) => {
    await openAndRun(page, await example());
    await reproduced(page);
    expect(await isolated(page)).toBe(false);
    await kept(page);
    host.stop();
    await page.context().setOffline(true);

    const modules: string[] = [];
    page.on('request', (request) => {
      if (request.url().endsWith('.wasm')) modules.push(request.url().replace(/.*\/engine-\w+\//, ''));
    });
    // The case that was open goes on.
    await page.reload();
    await expect(page.locator('.labels tbody tr')).not.toHaveCount(0);
    await idle(page);
    expect(await isolated(page)).toBe(true);
    await page.getByTestId('run').click();
    await meshed(page);
    await reproduced(page);

    // A link that somebody has sent, and the examples.
    await page.goto(`?threads=off${link(await example('heart-wave')).slice(2)}`);
    await page.getByRole('button', { name: 'Open and run' }).click();
    await meshed(page);
    await reproduced(page);
    expect(modules).toEqual(['threads/voxtet_engine.wasm', 'voxtet_engine.wasm']);
    await page.getByRole('button', { name: 'Examples…' }).click();
    const pictures = page.getByRole('dialog').locator('img');
    await expect(pictures).toHaveCount(6);
    await expect
      .poll(() => pictures.evaluateAll((all: HTMLImageElement[]) => all.every((one) => one.naturalWidth > 0)))
      .toBe(true);
  });
});

test('the app can be installed', async ({ page }) => {
  await page.goto('./');
  await kept(page);
  const session = await page.context().newCDPSession(page);
  expect((await session.send('Page.getAppManifest')).errors).toEqual([]);
  const { installabilityErrors } = await session.send('Page.getInstallabilityErrors');
  // Each test has a profile that is forgotten after it, in which nothing can be installed.
  expect(installabilityErrors.filter(({ errorId }) => errorId !== 'in-incognito')).toEqual([]);
});

/** The app with other names for all that its build names by content, and a mark that tells it from the one before. */
async function nextVersion(root: string): Promise<string> {
  const next = `${root}-next`;
  await cp(root, next, { recursive: true });
  const assets = join(next, 'assets');
  const names = (await readdir(assets)).filter((name) => /-.{8}\.(js|css)(\.br|\.gz)?$/.test(name));
  const renamed = (text: string) =>
    text.replace(/-([\w-]{8})(?=\.(js|css)\b)/g, (_, digest) => `-${digest.slice(1)}_`);
  for (const name of names) {
    if (/\.(js|css)$/.test(name))
      await writeFile(join(assets, renamed(name)), renamed(await readFile(join(assets, name), 'utf8')));
    await rm(join(assets, name));
  }
  for (const name of ['index.html', 'verification.html']) {
    const text = renamed(await readFile(join(next, name), 'utf8'));
    await writeFile(join(next, name), text.replace('<title>', '<title>Next '));
    for (const ending of ['br', 'gz']) await rm(join(next, `${name}.${ending}`), { force: true });
  }
  await writeServiceWorker(next);
  return next;
}

test.describe('where only the service worker keeps files', () => {
  test.use({ plain: true });

  test('a new version is announced, and the page goes on with its own until it is reloaded', async ({
    page,
    host,
  }) => {
    await page.goto('./');
    await kept(page);
    await rename(host.root, `${host.root}-before`);
    await rename(await nextVersion(`${host.root}-before`), host.root);
    // As when one comes back to the tab.
    await page.evaluate(() => document.dispatchEvent(new Event('visibilitychange')));
    const notice = page.getByText('A new version is there');
    await expect(notice).toBeVisible();

    host.asked.length = 0;
    await page.goto(link(await example()));
    await page.getByRole('button', { name: 'Open and run' }).click();
    await meshed(page);
    await reproduced(page);
    await expect(page).toHaveTitle(/^(?!Next)/);
    expect(host.asked.filter((path) => path !== '/sw.js')).toEqual([]);

    await page.getByRole('button', { name: 'Reload' }).click();
    await expect(page).toHaveTitle(/^Next/);
    await idle(page);
    await page.getByTestId('run').click();
    await meshed(page);
    await reproduced(page);
    await expect(notice).toBeHidden();
    // Nobody needs the version before any more.
    await expect.poll(() => page.evaluate(() => caches.keys())).toHaveLength(1);
  });
});

test('a page of the same origin may embed the app although its files are kept', async ({ page, host }) => {
  await page.goto('./');
  await kept(page);
  const ball = { source: { phantom: { kind: 'sphere' } }, sizing: { edge_mm: 6 } };
  await writeFile(
    join(host.root, 'around.html'),
    `<!doctype html><link rel="icon" href="icon.svg" /><iframe src="./?embed${link(ball).slice(2)}"></iframe>`,
  );
  await page.goto('./around.html');
  await expect(page.frameLocator('iframe').locator('.poster')).toContainText('sphere');
});
