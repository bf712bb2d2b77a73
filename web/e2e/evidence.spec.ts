/** What a run leaves in the hand: a report, and the run before beside it. */
import AxeBuilder from '@axe-core/playwright';
import { strFromU8, unzipSync } from 'fflate';
import { readFile } from 'node:fs/promises';
import { expect, meshed, openAndRun, pixels, smallHeart, stage, test } from './support';

test('a reviewer opens a link, reproduces it, and keeps the evidence: page, print, research object', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByTestId('share-link')).toHaveValue(/#c1=/);
  const url = await page.getByTestId('share-link').inputValue();
  const tets = await page.getByTestId('tets').innerText();

  const fresh = await page.context().browser()!.newContext({ colorScheme: 'dark' });
  const reviewer = await fresh.newPage();
  await reviewer.goto(url);
  await reviewer.getByRole('button', { name: 'Open and run' }).click();
  await meshed(reviewer);
  await expect(reviewer.getByTestId('verdict')).toContainText('Reproduced');
  await reviewer.getByRole('button', { name: "Reviewer's page" }).click();
  const dialog = reviewer.getByRole('dialog');
  await expect(dialog.getByText('The mesh: reproduced, byte for byte.')).toBeVisible();
  await expect(dialog.getByText(/checks that a simulation needs hold/)).toBeVisible();
  for (const heading of ['What it is', 'Checks', 'Distributions', 'Fidelity to the labels', 'How to cite'])
    await expect(dialog.getByRole('heading', { name: heading })).toBeAttached();
  const { violations } = await new AxeBuilder({ page: reviewer }).include('dialog').analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  // What is printed is the page, all of it, and nothing of the app.
  const pdf = (await reviewer.pdf()).toString('latin1');
  expect(pdf.match(/\/Type\s*\/Page\b/g)!.length).toBeGreaterThan(2);

  const saving = reviewer.waitForEvent('download');
  await dialog.getByRole('button', { name: 'Page (HTML)' }).click();
  const saved = await saving;
  expect(saved.suggestedFilename()).toBe('biventricle.report.html');
  const html = await readFile(await saved.path(), 'utf8');
  expect(html).toContain(tets);
  await expect(reviewer.locator('.pane.axial')).toBeHidden();
  const reader = await fresh.newPage();
  await reader.setContent(html);
  await expect(reader.getByRole('heading', { name: 'Checks' })).toBeVisible();
  expect(
    await reader
      .locator('img')
      .evaluateAll((all) => all.map((one) => (one as HTMLImageElement).naturalWidth > 0)),
  ).toEqual([true, true]);
  await reader.close();

  const packing = reviewer.waitForEvent('download');
  await dialog.getByRole('button', { name: 'Research object' }).click();
  const files = unzipSync(await readFile(await (await packing).path()));
  const crate = JSON.parse(strFromU8(files['ro-crate-metadata.json']));
  const root = crate['@graph'].find((one: { '@id': string }) => one['@id'] === './');
  const parts = root.hasPart.map((one: { '@id': string }) => one['@id']).sort();
  expect([...parts, 'ro-crate-metadata.json'].sort()).toEqual(Object.keys(files).sort());
  expect(parts).toContain('biventricle.vtu');
  const kept = JSON.parse(strFromU8(files['biventricle.case.json']));
  expect(kept.expected.digest).toMatch(/^[0-9a-f]{64}$/);
  await fresh.close();
});

test('a pinned run stands beside the next one, with one camera and a table of differences', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Pin this run' }).click();
  await page.getByLabel('Edge length', { exact: true }).fill('7');
  await page.getByTestId('run').click();
  await meshed(page);
  const table = page.getByTestId('differences');
  await expect(table.locator('tbody tr').first()).toContainText('Tetrahedra');
  await expect(table.locator('tbody tr').first()).toContainText('−');
  await expect(page.locator('.changes')).toContainText('Element size: edge length');
  await expect(page.locator('.changes')).toContainText('5 → 7');
  await expect(page.locator('.histogram-key').first()).toContainText('Pinned');
  await page.getByRole('button', { name: 'Side by side' }).click();
  const both = await Promise.all(
    ['twin', 'model'].map(async (name) => (await page.locator(`.pane.${name}`).boundingBox())!),
  );
  const middles = both.flatMap((box) =>
    [0.4, 0.5, 0.6].map((y) => ({
      x: Math.round(box.x + box.width / 2),
      y: Math.round(box.y + y * box.height),
    })),
  );
  await page.waitForTimeout(600);
  const before = await pixels(page, middles);
  await page.mouse.move(both[0].x + 60, both[0].y + 200);
  await page.mouse.down();
  await page.mouse.move(both[0].x + 160, both[0].y + 220, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(600);
  const after = await pixels(page, middles);
  expect(after.slice(0, 3)).not.toEqual(before.slice(0, 3));
  expect(after.slice(3)).not.toEqual(before.slice(3));
  await page.getByRole('button', { name: 'Unpin' }).click();
  await expect(page.locator('.pane.twin')).toBeHidden();
});

test('an edit marks the stages it touches; only those run again, as far as is asked', async ({ page }) => {
  await openAndRun(page, smallHeart);
  await page.getByLabel('Edge length', { exact: true }).fill('6');
  for (const name of ['volume', 'surface', 'smooth'])
    await expect(stage(page, name)).toHaveAttribute('data-state', 'done');
  for (const name of ['sizing', 'remesh', 'optimise', 'quality'])
    await expect(stage(page, name)).toHaveAttribute('data-state', 'stale');
  await page.getByRole('button', { name: 'Run to Remesh' }).click();
  await expect(stage(page, 'remesh')).toHaveAttribute('data-state', 'done');
  await expect(stage(page, 'remesh')).toHaveAttribute('aria-current', 'step');
  await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'stale');
  await expect(stage(page, 'smooth')).toHaveAttribute('data-kept', 'true');
  await page.getByTestId('run').click();
  await meshed(page);
  for (const name of ['volume', 'smooth', 'sizing', 'remesh'])
    await expect(stage(page, name)).toHaveAttribute('data-kept', 'true');
  await expect(stage(page, 'quality')).toHaveAttribute('data-kept', 'false');
  await page.getByLabel('Edge length', { exact: true }).fill('7');
  await expect(stage(page, 'sizing')).toHaveAttribute('data-state', 'stale');
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(stage(page, 'sizing')).toHaveAttribute('data-state', 'done');
});

test('the digest is shortened, and copied whole', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Copy the digest' }).click();
  await expect(page.locator('.digest')).toContainText('Copied');
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  expect(copied).toMatch(/^[0-9a-f]{64}$/);
  await expect(page.locator('.digest code')).toHaveText(`${copied.slice(0, 12)}…`);
});
