/** What a run leaves in the hand: a report, and the run before beside it. */
import { readFile } from 'node:fs/promises';
import { expect, meshed, openAndRun, pixels, smallHeart, stage, test } from './support';

test('the report is a page with pictures that needs nothing else', async ({ page }) => {
  await openAndRun(page, smallHeart);
  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Page with pictures' }).click();
  const download = await downloading;
  expect(download.suggestedFilename()).toBe('biventricle.report.html');
  const html = await readFile(await download.path(), 'utf8');
  expect(html.match(/<img src="data:image\/png/g)).toHaveLength(2);
  expect(html).toContain(await page.getByTestId('tets').innerText());
  await expect(page.locator('.pane.axial')).toBeHidden();
  const reader = await page.context().newPage();
  await reader.setContent(html);
  await expect(reader.getByRole('heading', { name: 'Checklist' })).toBeVisible();
  expect(
    await reader
      .locator('img')
      .evaluateAll((all) => all.map((one) => (one as HTMLImageElement).naturalWidth > 0)),
  ).toEqual([true, true]);
  await reader.close();
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
