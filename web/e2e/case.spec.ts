/** The case: examples, what was read, labels, regions on the slices, the sizing field before any mesh. */
import type { Page } from '@playwright/test';
import { expect, idle, link, smallHeart, stage, test } from './support';

async function open(page: Page, recipe: object): Promise<void> {
  await page.goto(link(recipe));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
}

test('an example with its picture opens with a click, and another from the case panel', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  const cards = page.getByRole('list', { name: 'Examples' }).getByRole('button');
  await expect(cards).toHaveCount(6);
  for (const picture of await cards.locator('img').all()) {
    await picture.scrollIntoViewIfNeeded();
    await expect(picture).toHaveJSProperty('complete', true);
    expect(await picture.evaluate((image) => (image as HTMLImageElement).naturalWidth)).toBeGreaterThan(100);
  }
  await page.getByRole('button', { name: /Torus/ }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.locator('.case-name')).toHaveText('torus');
  await idle(page);
  await page.getByRole('button', { name: 'Examples…' }).click();
  await page
    .getByRole('dialog')
    .getByRole('button', { name: /Oblique shell/ })
    .click();
  await expect(page.locator('.case-name')).toHaveText('shell');
  await expect(page.locator('.read-facts')).toContainText('oblique by');
  await expect(page.getByRole('dialog')).toHaveCount(0);
});

test('what was read is shown: voxels, spacing, extent, orientation, labels with their volumes', async ({
  page,
}) => {
  await open(page, { source: { phantom: { kind: 'biventricle', spacing_mm: [2, 2, 3], mirrored: true } } });
  const facts = page.locator('.read-facts');
  await expect(facts).toContainText('2 × 2 × 3 mm');
  await expect(facts).toContainText('LAS');
  const row = page.locator('.labels tbody tr').first();
  const [voxels, ml] = (await row.locator('.label-counts').innerText())
    .replaceAll(',', '')
    .match(/[\d.]+/g)!
    .map(Number);
  expect(ml).toBeCloseTo((voxels * 2 * 2 * 3) / 1000, 0);
});

test('a region is dragged and resized on a slice, in one step of undo each, and the forecast follows', async ({
  page,
}) => {
  await open(page, smallHeart);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  await page.getByRole('button', { name: 'Sphere', exact: true }).click();
  const radius = page.getByLabel('Region 1: Radius');
  const right = page.getByLabel('Centre R');
  const [before, size] = [Number(await right.inputValue()), Number(await radius.inputValue())];
  const forecast = page.getByTestId('forecast');
  await expect(forecast).toHaveAttribute('aria-busy', 'false');
  const foretold = await forecast.innerText();
  const box = (await page.locator('.pane.axial .pane-surface').boundingBox())!;
  const outline = (await page.locator('.pane.axial .slice-regions .chosen:not(.band)').boundingBox())!;
  const middle = { x: outline.x + outline.width / 2, y: outline.y + outline.height / 2 };
  await page.mouse.move(middle.x, middle.y);
  await page.mouse.down();
  await page.mouse.move(middle.x - 30, middle.y, { steps: 5 });
  await page.mouse.up();
  expect(box.width).toBeGreaterThan(100);
  // The patient's right is on the left.
  expect(Number(await right.inputValue())).toBeGreaterThan(before + 3);
  const edge = { x: middle.x - 30 + outline.width / 2, y: middle.y };
  await page.mouse.move(edge.x, edge.y);
  await page.mouse.down();
  await page.mouse.move(edge.x + 20, edge.y, { steps: 5 });
  await page.mouse.up();
  expect(Number(await radius.inputValue())).toBeGreaterThan(size + 2);
  await expect(forecast).not.toHaveText(foretold);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(radius).toHaveValue(String(size));
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(right).toHaveValue(String(before));
});

test('the sizing field is on the slices before any mesh, and follows an edit', async ({ page }) => {
  await open(page, smallHeart);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await expect(stage(page, 'sizing')).toHaveAttribute('data-state', 'done');
  await expect(page.locator('.scale-strip')).toContainText('3');
  const scale = await page.locator('.scale-strip').innerText();
  await page.getByLabel('Edge length', { exact: true }).fill('9');
  await expect(page.locator('.scale-strip')).not.toHaveText(scale);
  await expect(stage(page, 'remesh')).toHaveAttribute('data-state', 'waiting');
});

test('a region is dragged and resized in the 3-D view, in one step of undo each', async ({ page }) => {
  // The body is centred in its image, so that the new region and its handle stand in the middle of the view.
  await open(page, { source: { phantom: { kind: 'sphere', spacing_mm: [2, 2, 2] } } });
  await page.getByRole('button', { name: 'Sphere', exact: true }).click();
  const radius = page.getByLabel('Region 1: Radius');
  const places = ['R', 'A', 'S'].map((side) => page.getByLabel(`Centre ${side}`));
  const centre = async () => Promise.all(places.map(async (field) => Number(await field.inputValue())));
  const undo = page.getByRole('button', { name: 'Undo' });
  const [before, size] = [await centre(), Number(await radius.inputValue())];
  const drag = async () => {
    const box = (await page.locator('.pane.model .pane-surface').boundingBox())!;
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 60, y - 40, { steps: 8 });
    await page.mouse.up();
  };
  await drag();
  await expect(undo).toHaveAttribute('title', 'Undo: Move region');
  const moved = await centre();
  expect(Math.hypot(...moved.map((x, i) => x - before[i]))).toBeGreaterThan(3);
  expect(await radius.inputValue()).toBe(String(size));
  await undo.click();
  expect(await centre()).toEqual(before);
  await page
    .getByRole('group', { name: 'Handle in the view' })
    .getByRole('button', { name: 'Resize' })
    .click();
  await drag();
  await expect(undo).toHaveAttribute('title', 'Undo: Resize region');
  expect(Number(await radius.inputValue())).not.toBe(size);
  expect(await centre()).toEqual(before);
  await undo.click();
  await expect(radius).toHaveValue(String(size));
});
