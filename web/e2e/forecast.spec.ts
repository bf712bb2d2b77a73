/** What a run will take, told before it: the forecast, sizes by number, limits, curvature. */
import type { Page } from '@playwright/test';
import { expect, fineHeart, idle, link, meshed, smallHeart, stage, test, tetCount } from './support';

const note = (page: Page) => page.getByTestId('forecast');
const undo = (page: Page) => page.getByRole('button', { name: 'Undo' });

/** Tetrahedra of the forecast, once it is that of the recipe as it stands. */
async function foretold(page: Page): Promise<number> {
  await expect(note(page)).toHaveAttribute('aria-busy', 'false');
  return Number(/about ([\d,]+) tetrahedra/.exec(await note(page).innerText())![1].replaceAll(',', ''));
}

async function open(page: Page, recipe: object = smallHeart): Promise<void> {
  await page.goto(link(recipe));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
}

test('the forecast follows the sizes, is right about the mesh, and goes when the mesh is there', async ({
  page,
}) => {
  await open(page);
  const coarse = await foretold(page);
  await expect(note(page)).toHaveAttribute(
    'title',
    /Forecast: about [\d,]+ tetrahedra, \d+ MB, \d+( to \d+)? s\./,
  );
  const edge = page.getByLabel('Edge length', { exact: true });
  await edge.fill('4');
  await expect.poll(() => foretold(page)).toBeGreaterThan(1.2 * coarse);
  const expected = await foretold(page);
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(note(page)).toHaveCount(0);
  const found = await tetCount(page);
  expect(Math.abs(found / expected - 1)).toBeLessThan(0.3);
  await undo(page).click();
  await expect.poll(() => foretold(page)).toBe(coarse);
  await page.waitForTimeout(1000); // longer than a preview waits
  // A forecast of other sizes has cost nothing of the mesh.
  await page.getByRole('button', { name: 'Redo' }).click();
  await expect(note(page)).toHaveCount(0);
  await page.getByTestId('run').click();
  await expect(stage(page, 'optimise')).toHaveAttribute('data-kept', 'true');
  await idle(page);
});

test('the forecast changes while a region is being dragged', async ({ page }) => {
  await open(page);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  await page.getByRole('button', { name: 'Sphere', exact: true }).click();
  await page.getByLabel('Region 1: Edge inside').fill('1');
  await foretold(page);
  const outline = (await page.locator('.pane.axial .slice-regions .chosen:not(.band)').boundingBox())!;
  const [x, y] = [outline.x + outline.width / 2, outline.y + outline.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const seen = new Set<number>([await foretold(page)]);
  for (const way of [-25, -50, -75, -100]) {
    await page.mouse.move(x + way, y, { steps: 3 });
    await expect(note(page)).toHaveAttribute('aria-busy', 'false');
    seen.add(await foretold(page));
  }
  expect(seen.size).toBeGreaterThan(2);
  await page.mouse.up();
  await expect(undo(page)).toHaveAttribute('title', 'Undo: Move region');
});

test('sizes for a number of tetrahedra are found, used, and undone in one step', async ({ page }) => {
  await open(page);
  await foretold(page);
  const edge = page.getByLabel('Edge length', { exact: true });
  const scar = page.getByLabel('Edge length of Scar core');
  await page.getByRole('button', { name: 'By number…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Sizes for a number of tetrahedra' });
  await dialog.getByLabel('Tetrahedra').fill('40000');
  await page.keyboard.press('Enter');
  await expect(dialog).toContainText(/Edge length \d\.\d+ mm/);
  await expect(dialog).toContainText('about 40,000 tetrahedra');
  await dialog.getByRole('button', { name: 'Use these sizes' }).click();
  await expect(edge).not.toHaveValue('5');
  await expect(edge).toHaveValue(/^\d\.\d{1,3}$/);
  await expect(scar).not.toHaveValue('3');
  await expect.poll(() => foretold(page)).toBe(40_000);
  await expect(undo(page)).toHaveAttribute('title', 'Undo: Sizes for 40,000 tetrahedra');
  await undo(page).click();
  await expect(edge).toHaveValue('5');
  await expect(scar).toHaveValue('3');
});

test('closing the dialog ends the search for sizes', async ({ page }) => {
  await open(page, fineHeart);
  await foretold(page);
  await page.getByRole('button', { name: 'By number…' }).click();
  const dialog = page.getByRole('dialog');
  await dialog.getByLabel('Tetrahedra').fill('3');
  const ended = Promise.race(page.workers().map((worker) => worker.waitForEvent('close')));
  await dialog.getByRole('button', { name: 'Find sizes' }).click();
  await expect(dialog.getByRole('button', { name: 'Looking…' })).toBeVisible();
  await page.keyboard.press('Escape');
  await ended;
  await page.getByLabel('Edge length', { exact: true }).fill('3');
  await foretold(page);
});

test('sizes that no edge length gives are said not to be found', async ({ page }) => {
  await open(page);
  await foretold(page);
  await page.getByRole('button', { name: 'By number…' }).click();
  const dialog = page.getByRole('dialog');
  await dialog.getByLabel('Tetrahedra').fill('3');
  await dialog.getByRole('button', { name: 'Find sizes' }).click();
  await expect(dialog.getByRole('status')).toContainText('edge lengths');
  await expect(dialog.getByRole('button', { name: 'Use these sizes' })).toBeDisabled();
});

test('a limit is named before the run that it refuses, and fits the sizes', async ({ page }) => {
  await open(page);
  const count = await foretold(page);
  const limit = Math.round(count / 2);
  await page.getByText('Limits', { exact: true }).click();
  await page.getByLabel('Limits: Most tetrahedra').fill(String(limit));
  await expect(note(page)).toHaveClass(/caution/);
  await expect(note(page)).toContainText(`limits.tets: the forecast is about ${count.toLocaleString('en')}`);
  await expect(page.locator('.panel.left .stale', { hasText: 'limits.tets' })).toBeVisible();
  await page.getByTestId('run').click();
  await expect(page.getByRole('alert')).toContainText('limits.tets');
  await idle(page);
  await page.getByRole('button', { name: 'By number…' }).click();
  const dialog = page.getByRole('dialog');
  await expect(dialog.getByLabel('Tetrahedra')).toHaveValue(String(limit));
  await dialog.getByRole('button', { name: 'Find sizes' }).click();
  await dialog.getByRole('button', { name: 'Use these sizes' }).click();
  await expect(note(page)).not.toHaveClass(/caution/);
  await page.getByTestId('run').click();
  await meshed(page);
});

test('a mesh beyond the memory of a tab is refused at once; the case stays and the next run works', async ({
  page,
}) => {
  await open(page);
  const edge = page.getByLabel('Edge length', { exact: true });
  const usual = await edge.inputValue();
  await edge.fill('0.1');
  await expect(note(page)).toContainText('million tetrahedra');
  await page.getByTestId('run').click();
  await page.getByRole('dialog').getByRole('button', { name: 'Run all the same' }).click();
  await expect(page.getByRole('alert')).toContainText('no more than 4295 MB can be had here');
  await expect(page.getByRole('alert')).toContainText('times as large would fit');
  await idle(page);
  await expect(edge).toHaveValue('0.1');
  await edge.fill(usual);
  await page.getByTestId('run').click();
  await meshed(page);
});

test('surfaces are sized by curvature; sizes and limits come back with link and reload', async ({
  page,
  browser,
}) => {
  await open(page);
  const before = await foretold(page);
  await page.getByRole('button', { name: 'Curvature', exact: true }).click();
  const surfaces = page.getByRole('group', { name: 'Surfaces of' });
  await expect(surfaces.getByRole('button')).toHaveCount(smallHeart.labels.length);
  await surfaces.getByRole('button', { name: 'LV myocardium' }).click();
  await page.getByLabel('LV myocardium: Edges to a full turn').fill('40');
  await page.getByLabel('LV myocardium: Smallest edge').fill('1');
  await expect.poll(() => foretold(page)).toBeGreaterThan(1.1 * before);
  await undo(page).click();
  await expect(page.getByLabel('LV myocardium: Smallest edge')).toHaveValue('1.3');
  await page.getByText('Limits', { exact: true }).click();
  await page.getByLabel('Limits: Most time').fill('900');
  await page.waitForTimeout(1500);
  await page.goto('./');
  await page.getByRole('button', { name: /^LV myocardium 40 to a turn/ }).click();
  await expect(page.getByLabel('LV myocardium: Smallest edge')).toHaveValue('1.3');
  await page.getByText('Limits', { exact: true }).click();
  await expect(page.getByLabel('Limits: Most time')).toHaveValue('900');
  await idle(page);
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByTestId('share-link')).toHaveValue(/#c1=/);
  const url = await page.getByTestId('share-link').inputValue();
  // Here the page knows the case as its own, and would not ask.
  const other = await (await browser.newContext()).newPage();
  await other.goto(url);
  await expect(other.getByRole('dialog')).toContainText('40 edges to a turn');
  await other.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(other.getByRole('button', { name: /^LV myocardium 40 to a turn/ })).toBeVisible();
  await foretold(other);
  await other.getByTestId('run').click();
  await meshed(other);
  await other.context().close();
});
