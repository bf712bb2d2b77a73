/** The app as a part of another page, on another origin. */
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import AxeBuilder from '@axe-core/playwright';
import type { Frame, Page } from '@playwright/test';
import { port } from './browser';
import { expect, idle, link, test } from './support';

/** A server on another port is another origin. What it sends is the test's own. */
const hostPort = port + 500;
const host = `http://127.0.0.1:${hostPort}/`;
test.use({ otherHost: host });

let sent: { body: string; headers: Record<string, string> };
const server = createServer((_, response) =>
  response.writeHead(200, { 'Content-Type': 'text/html', ...sent.headers }).end(sent.body),
);
test.beforeAll(() => new Promise<void>((listening) => void server.listen(hostPort, '127.0.0.1', listening)));
test.afterAll(() => void server.close());

function visit(page: Page, body: string, headers: Record<string, string> = {}) {
  sent = { body, headers };
  return page.goto(host);
}

const example = readFileSync(
  join(dirname(fileURLToPath(import.meta.url)), '../../examples/embed/index.html'),
  'utf8',
);
const app = `http://127.0.0.1:${port}/`;

const ball = {
  source: { phantom: { kind: 'sphere', radius_mm: 20, spacing_mm: [3, 3, 3] } },
  sizing: { edge_mm: 6 },
};

const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

interface Told {
  type: string;
  code?: string;
  message?: string;
  report?: { digest: string; tets: number };
  verdict?: { mesh: string } | null;
}

/** Opens a page with the app in it, which keeps what it is told. */
async function embed(page: Page, src = `${app}?embed`, headers: Record<string, string> = {}): Promise<Frame> {
  const frame = `<iframe src="${src}" style="width: 720px; height: 480px" title="voxtet" allow="cross-origin-isolated"></iframe>`;
  const script = 'window.told = []; addEventListener("message", ({ data }) => window.told.push(data));';
  const body = `<!doctype html><html lang="en"><title>A page</title><script>${script}</script><main>${frame}</main></html>`;
  await visit(page, body, headers);
  await told(page, 'voxtet:ready');
  return page.frames().find((one) => one.url().startsWith(app))!;
}

/** What the page is told of a type, once it is. */
async function told(page: Page, type: string): Promise<Told> {
  const all = () => page.evaluate(() => (window as unknown as { told: Told[] }).told);
  await expect.poll(async () => (await all()).map((one) => one.type)).toContain(type);
  return (await all()).filter((one) => one.type === type).at(-1)!;
}

const forget = (page: Page) => page.evaluate(() => void ((window as unknown as { told: Told[] }).told = []));

const say = (page: Page, message: unknown) =>
  page.evaluate((data) => frames[0].postMessage(data, '*'), message);

test('the example opens a case by message, and is told the digest of the whole app', async ({
  page,
  browser,
}) => {
  await visit(page, example.replace('http://127.0.0.1:8123/', app));
  const frame = page.frameLocator('iframe');
  const button = frame.getByTestId('embed-button');
  await expect(frame.locator('.poster')).toContainText('biventricle');
  await expect(button).toBeEnabled();
  await button.click();
  await expect(page.locator('output')).toContainText('digest');
  await expect(frame.locator('.embed-status')).toContainText('tetrahedra');
  await expect(button).toHaveCount(0);
  const [, digest] = /digest (\w+)/.exec(await page.locator('output').innerText()) ?? [];

  const whole = await (await browser.newContext()).newPage();
  const way = await frame.getByRole('link', { name: 'Open in voxtet' }).getAttribute('href');
  await whole.goto(`${app}${way}`);
  await whole.getByRole('button', { name: 'Open and run' }).click();
  await expect(whole.locator('.evidence, .panel.right')).toContainText(digest.slice(0, 12));
  await whole.context().close();
});

for (const isolated of [true, false])
  test(`a link is checked, runs at a word and is reproduced, ${isolated ? 'with' : 'without'} threads`, async ({
    page,
  }) => {
    const frame = await embed(page, `${app}?embed${link(ball).slice(2)}`, isolated ? isolation : {});
    expect(await frame.evaluate(() => crossOriginIsolated)).toBe(isolated);
    await expect(frame.locator('.poster')).toContainText('sphere');
    await say(page, { type: 'voxtet:run' });
    const first = await told(page, 'voxtet:done');
    expect(first.verdict).toBe(null);
    await told(page, 'voxtet:progress');
    const { digest, tets } = first.report!;
    await forget(page);
    const { engine } = (first as { report: { engine?: string } }).report;
    await say(page, { type: 'voxtet:open', case: { ...ball, expected: { engine, digest, tets } } });
    await expect(frame.locator('.poster')).toContainText('promised');
    await say(page, {
      type: 'voxtet:view',
      view: { colour: 'mean_ratio', cut: { normal: [0, 1, 0], place: 0.5 } },
    });
    await say(page, { type: 'voxtet:run' });
    expect((await told(page, 'voxtet:done')).verdict?.mesh).toBe('reproduced');
    await expect(frame.locator('.embed-status')).toContainText('reproduced');
    await expect(frame.locator('.legend-title, .legend')).not.toHaveCount(0);
  });

test('what makes no sense is answered by an error, and strangers are not heard', async ({ page }) => {
  const frame = await embed(page);
  for (const [message, words] of [
    [{ type: 'voxtet:open' }, 'expected a recipe'],
    [{ type: 'voxtet:open', case: '#c1=%%' }, 'base64url'],
    [{ type: 'voxtet:open', case: { sizing: { edge: 1 } } }, 'edge'],
    [{ type: 'voxtet:open', case: { source: { file: { name: 'heart.nii' } } } }, 'needs a file'],
    [{ type: 'voxtet:run', version: 2 }, 'version'],
    [{ type: 'voxtet:view', view: { cut: { place: 2 } } }, 'view.cut.place'],
    [{ type: 'voxtet:view', view: { colours: 'label' } }, 'view.colours'],
    [{ type: 'voxtet:fetch', url: 'https://data.example/heart.nii' }, 'voxtet:fetch'],
  ] as const) {
    await forget(page);
    await say(page, message);
    expect((await told(page, 'voxtet:error')).message).toContain(words);
  }
  await expect(frame.getByTestId('embed-button')).toBeDisabled();
  await forget(page);
  // Of other programs, of a sibling frame, of the app's own window.
  await say(page, 'hello');
  await say(page, { type: 'resize' });
  await page.evaluate(() => {
    const sibling = document.body.appendChild(document.createElement('iframe'));
    const script = sibling.contentDocument!.createElement('script');
    script.textContent = 'top.frames[0].postMessage({ type: "voxtet:nonsense" }, "*")';
    sibling.contentDocument!.body.append(script);
  });
  await frame.evaluate(() => window.postMessage({ type: 'voxtet:nonsense' }));
  // The page's own message after them is answered alone.
  await say(page, { type: 'voxtet:last' });
  await told(page, 'voxtet:error');
  const all = await page.evaluate(() => (window as unknown as { told: Told[] }).told);
  expect(all.map(({ message }) => message)).toEqual([expect.stringContaining('voxtet:last')]);
});

test('another page than the one that is named is told nothing, and not heard', async ({ page }) => {
  await visit(
    page,
    `<!doctype html><script>window.told = []; addEventListener("message", ({ data }) => told.push(data))</script>
    <iframe src="${app}?embed=https://course.example"></iframe>`,
  );
  const frame = page.frameLocator('iframe');
  await expect(frame.locator('.app')).toHaveAttribute('data-activity', 'idle');
  await say(page, { type: 'voxtet:open', case: ball });
  await expect(frame.locator('.poster')).toContainText('There is no case');
  expect(await page.evaluate(() => (window as unknown as { told: Told[] }).told)).toEqual([]);
});

test('in a frame nothing is fetched or opened, and without ?embed a server lets nobody frame it', async ({
  page,
}) => {
  await page.route('https://data.example/**', () => {
    throw new Error('The embedded app has asked another host.');
  });
  const away = encodeURIComponent('https://data.example/heart.nii');
  const frame = await embed(page, `${app}?embed&volume=${away}&case=${away}`);
  await expect(frame.getByRole('dialog')).toHaveCount(0);
  await expect(frame.getByRole('button')).toHaveCount(1);
  const answer = async (path: string) => (await page.request.get(`${app}${path}`)).headers();
  expect((await answer(''))['content-security-policy']).toContain("frame-ancestors 'none'");
  const embedded = await answer('?embed');
  expect(embedded['content-security-policy']).not.toContain('frame-ancestors');
  expect(embedded['cross-origin-resource-policy']).toBe('cross-origin');
});

test('a server that lets it be framed gets no more than that into a frame', async ({ page }) => {
  await page.route(app, async (route) => {
    const response = await route.fetch();
    const headers = response.headers();
    const policy = headers['content-security-policy'].replace("; frame-ancestors 'none'", '');
    await route.fulfill({ response, headers: { ...headers, 'content-security-policy': policy } });
  });
  const frame = await embed(page, `${app}${link(ball).slice(2)}`);
  await expect(frame.getByRole('button')).toHaveCount(1);
  await expect(frame.locator('.header')).toHaveCount(0);
});

test('Share has the code that embeds a case', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.goto(link(ball));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await page.getByRole('button', { name: 'Share' }).click();
  await page.getByRole('button', { name: 'Copy embed code' }).click();
  await expect(page.getByText('Copied')).toBeVisible();
  const code = await page.evaluate(() => navigator.clipboard.readText());
  await visit(page, `<!doctype html>${code}`);
  await expect(page.frameLocator('iframe').locator('.poster')).toContainText('sphere');
});

test('a run is cancelled by its button, and the page hears of it; the case of the app itself stays', async ({
  page,
}) => {
  const frame = await embed(page);
  await say(page, { type: 'voxtet:open', case: { ...ball, sizing: { edge_mm: 0.8 } } });
  await frame.getByTestId('embed-button').click();
  await expect(frame.getByTestId('embed-button')).toContainText('Cancel');
  await frame.getByTestId('embed-button').click();
  expect((await told(page, 'voxtet:error')).code).toBe('cancelled');
  await expect(frame.getByTestId('embed-button')).toContainText('Run');
  expect(await frame.evaluate(() => indexedDB.databases())).toEqual([]);
});

test('a wave is computed after the mesh, and its button plays it', async ({ page }) => {
  const wave = {
    source: { phantom: { kind: 'biventricle', spacing_mm: [4, 4, 4] } },
    labels: [1, 2],
    sizing: { edge_mm: 7 },
    physics: {
      anatomy: {},
      fibres: {},
      tissue: { kinds: [{ labels: [1, 2], along_mm_per_ms: 0.6, across_mm_per_ms: 0.3 }] },
      stimuli: [{ name: 'apex', centre_mm: [0, 0, -40], radius_mm: 14 }],
      monodomain: { end_ms: 20, step_ms: 0.2 },
    },
  };
  const frame = await embed(page, `${app}?embed${link(wave).slice(2)}`);
  await frame.getByTestId('embed-button').click();
  await expect(frame.getByTestId('embed-button')).toContainText('Play');
  await frame.getByTestId('embed-button').click();
  await expect(frame.getByTestId('embed-button')).toContainText('Pause');
});

for (const colorScheme of ['light', 'dark'] as const)
  test(`no serious accessibility finding in an embedded app (${colorScheme})`, async ({ page }) => {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    const frame = await embed(page, `${app}?embed${link(ball).slice(2)}`);
    const serious = async () => {
      const { violations } = await new AxeBuilder({ page }).analyze();
      return violations
        .filter(({ impact }) => impact === 'serious' || impact === 'critical')
        .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
    };
    expect(await serious()).toEqual([]);
    await frame.getByTestId('embed-button').click();
    await told(page, 'voxtet:done');
    await expect(frame.locator('.embed-status')).toContainText('tetrahedra');
    expect(await serious()).toEqual([]);
  });
