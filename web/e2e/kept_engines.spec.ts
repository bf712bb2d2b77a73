/** A deployment that keeps an engine of an earlier build beside its own. */
import { cpSync, mkdtempSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import type { Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { keepEngines } from '../keep_engines.mjs';
import { serve } from '../serve.mjs';
import { expect, idle, meshed, test } from './support';

const dist = join(dirname(fileURLToPath(import.meta.url)), '../dist');
const [[version, { folder }]] = Object.entries<{ folder: string }>(
  JSON.parse(readFileSync(join(dist, 'engines.json'), 'utf8')),
);
const laterVersion = `${version.slice(0, -12)}${'0'.repeat(12)}`;
const laterFolder = 'assets/engine-00000000/';

/** The build of a later engine: the same with another version written into it, under another digest. */
function laterBuild(): string {
  const later = mkdtempSync(join(tmpdir(), 'voxtet-later-'));
  cpSync(dist, later, { recursive: true });
  renameSync(join(later, folder), join(later, laterFolder));
  const rewrite = (path: string, from: string, to: string) => {
    const bytes = readFileSync(path).toString('latin1');
    if (bytes.includes(from)) writeFileSync(path, bytes.replaceAll(from, to), 'latin1');
  };
  for (const name of readdirSync(later, { recursive: true, encoding: 'utf8' })) {
    const path = join(later, name);
    if (/\.(br|gz)$/.test(name) && name.startsWith('assets')) rmSync(path);
    else if (name.endsWith('.wasm')) rewrite(path, version, laterVersion);
    else if (/\.(js|json)$/.test(name)) rewrite(path, folder, laterFolder);
  }
  rewrite(join(later, 'engines.json'), version, laterVersion);
  return later;
}

let later: string;
let server: Server;
let base: string;

test.beforeAll(async () => {
  later = laterBuild();
  server = await serve({ root: later, port: 0 });
  base = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
});
test.afterAll(() => {
  server.close();
  rmSync(later, { recursive: true });
});
test.use({ otherHost: 'http://127.0.0.1:' });

test('a link opens with the engine that made it where that is kept, and says so where it is not', async ({
  page,
}) => {
  const recipe = { source: { phantom: { kind: 'torus' } }, sizing: { edge_mm: 4 } };
  const at = (value: object) => `${base}#j=${encodeURIComponent(JSON.stringify(value))}`;
  await page.goto(`./#j=${encodeURIComponent(JSON.stringify(recipe))}`);
  await page.getByRole('button', { name: 'Open and run' }).click();
  await meshed(page);
  await page.getByRole('button', { name: 'Share' }).click();
  const field = page.getByTestId('share-link');
  await expect(field).toHaveValue(/#c1=/);
  const shared = new URL(await field.inputValue()).hash;

  // Not kept: the page's own engine, never in silence.
  await page.goto(base + shared);
  const dialog = page.getByRole('dialog');
  await expect(dialog).toContainText(
    `made with ${version}, which is not here; this page has ${laterVersion}`,
  );
  await dialog.getByRole('button', { name: 'Open and run' }).click();
  await meshed(page);
  await expect(page.getByTestId('verdict').locator('tr.other')).toContainText(laterVersion);

  expect(keepEngines(dist, later)).toEqual([version]);
  expect(keepEngines(dist, later)).toEqual([]);
  const fresh = await page.context().browser()!.newContext();
  const receiver = await fresh.newPage();
  const modules: string[] = [];
  receiver.on('request', (request) => {
    if (request.url().endsWith('.wasm')) modules.push(new URL(request.url()).pathname);
  });
  await receiver.goto(base + shared);
  await expect(receiver.getByRole('dialog')).toContainText(`${version}, the one that made it`);
  await receiver.getByRole('button', { name: 'Open and run' }).click();
  await meshed(receiver);
  const verdict = receiver.getByTestId('verdict');
  await expect(verdict).toContainText('Reproduced');
  await expect(verdict).toContainText(`The engine is voxtet ${version}, kept here`);
  await expect(verdict.locator('tr.other')).toHaveCount(0);
  const source = verdict.getByRole('link', { name: 'Its source' });
  expect((await receiver.request.head(base + (await source.getAttribute('href')))).ok()).toBe(true);
  expect(modules.some((path) => path.startsWith(`/${folder}`))).toBe(true);
  // A reload goes on with it; a case of the page's own has the page's own engine.
  await receiver.reload();
  await idle(receiver);
  await receiver.getByTestId('run').click();
  await meshed(receiver);
  await expect(receiver.getByTestId('verdict')).toContainText('kept here');
  await receiver.goto(at({ ...recipe, sizing: { edge_mm: 5 } }));
  await receiver.getByRole('button', { name: 'Open and run' }).click();
  await meshed(receiver);
  await receiver.getByRole('button', { name: 'Share' }).click();
  await expect(receiver.getByRole('dialog')).toContainText('Share this case');
  await receiver.keyboard.press('Escape');
  await receiver.getByRole('button', { name: 'About voxtet' }).click();
  await expect(receiver.getByRole('dialog')).toContainText(laterVersion);
  await fresh.close();
});
