/** The browser makes the very bytes that the command line makes. */
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { dropFile, expect, idle, link, meshed, openAndRun, realVolume, test } from './support';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const readJson = (path: string) => JSON.parse(readFileSync(path, 'utf8'));

// Those of hearts that beat or conduct are proved under node alone (tests/README.md).
const examples = readdirSync(join(root, 'examples')).filter((entry) => {
  const path = join(root, 'examples', entry, 'case.json');
  return existsSync(path) && !('physics' in readJson(path));
});

for (const name of examples) {
  test(`the example ${name} is reproduced`, async ({ page }) => {
    const folder = join(root, 'examples', name);
    const { engine, digest, tets } = readJson(join(folder, 'expected.json'));
    await openAndRun(page, { ...readJson(join(folder, 'case.json')), expected: { engine, digest, tets } });
    await expect(page.getByTestId('verdict')).toContainText('Reproduced');
  });
}

for (const isolated of [true, false])
  test(`${isolated ? 'an isolated page has threads' : 'a page that may not share memory has one thread'}`, async ({
    page,
  }) => {
    if (!isolated)
      await page.route(/\/(index\.html)?$/, async (route) => {
        const response = await route.fetch();
        const headers = response.headers();
        delete headers['cross-origin-opener-policy'];
        delete headers['cross-origin-embedder-policy'];
        await route.fulfill({ response, headers });
      });
    const modules = new Set<string>();
    page.on('request', (request) => {
      if (request.url().endsWith('.wasm')) modules.add(new URL(request.url()).pathname);
    });
    const folder = join(root, 'examples/biventricle-scar');
    const { engine, digest, tets } = readJson(join(folder, 'expected.json'));
    await openAndRun(page, { ...readJson(join(folder, 'case.json')), expected: { engine, digest, tets } });
    await expect(page.getByTestId('verdict')).toContainText('Reproduced');
    expect(await page.evaluate(() => crossOriginIsolated)).toBe(isolated);
    const names = [...modules].map((path) => path.replace(/^\/assets\/engine-\w+\//, ''));
    expect(names).toEqual([`${isolated ? 'threads/' : ''}voxtet_engine.wasm`]);
  });

test('a browser that calls a page isolated, but has no shared memory, gets the engine without threads', async ({
  page,
}) => {
  await page.addInitScript(() => void Reflect.deleteProperty(globalThis, 'SharedArrayBuffer'));
  const module = page.waitForRequest(/\.wasm$/);
  await page.goto('./');
  expect((await module).url()).toMatch(/engine-\w+\/voxtet_engine\.wasm$/);
  await idle(page);
});

test('a real heart with a scar gives the digest that the command line gives under node', async ({ page }) => {
  const path = realVolume('biv_ed_scar_1mm.nii.gz');
  test.skip(path === null, 'The folder of real volumes is not on this machine (set VOXTET_DATA).');
  const sizes = [5, 6].map((label) => ({ label, edge_mm: 0.8 }));
  const recipe = { labels: [1, 2, 5, 6], sizing: { edge_mm: 2, labels: sizes } };
  const options = [
    '--labels',
    '1,2,5,6',
    '--edge-mm',
    '2',
    '--edge-label',
    '5=0.8',
    '--edge-label',
    '6=0.8',
    '--json',
  ];
  const report = JSON.parse(
    execFileSync(process.execPath, [join(root, 'build/wasm/voxtet.mjs'), 'mesh', path!, ...options], {
      encoding: 'utf8',
      maxBuffer: 1 << 26,
      stdio: ['ignore', 'pipe', 'ignore'],
    }),
  );
  const { engine, digest, tets } = report;
  console.log(`node: ${tets} tetrahedra, ${digest}`);
  await page.goto(link({ source: report.recipe.source, ...recipe, expected: { engine, digest, tets } }));
  await page.getByRole('dialog').getByRole('button', { name: 'Open', exact: true }).click();
  await dropFile(page, path!);
  await expect(page.locator('.labels tbody tr')).toHaveCount(6);
  await idle(page);
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.getByTestId('verdict')).toContainText('Reproduced');
});
