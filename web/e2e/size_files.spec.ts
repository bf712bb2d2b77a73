/** Sizes that are painted or come from files, and colours: with undo, autosave, and links that say what they lack. */
import type { Page } from '@playwright/test';
import { maskFile, sizeImage } from './files';
import { dropFile, expect, idle, link, meshed, sampled, slice, smallHeart, stage, test } from './support';

const coarse = { source: smallHeart.source, labels: [1, 2], sizing: { edge_mm: 6 } };
const smallest = async (page: Page) =>
  Number((await stage(page, 'sizing').innerText()).match(/([\d.]+)–/)?.[1]);

async function open(page: Page, recipe: object): Promise<void> {
  await page.goto(link(recipe));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
}

async function stroke(page: Page, from: [number, number], to: [number, number]): Promise<void> {
  const box = (await slice(page, 'axial').locator('.pane-surface').boundingBox())!;
  const at = ([x, y]: [number, number]) => [box.x + x * box.width, box.y + y * box.height] as const;
  await page.mouse.move(...at(from));
  await page.mouse.down();
  await page.mouse.move(...at(to), { steps: 6 });
  await page.mouse.up();
}

test('sizes are painted on a slice, undone and erased, survive a reload and are meshed', async ({ page }) => {
  await open(page, coarse);
  await page.getByRole('button', { name: 'Paint…' }).click();
  await page.getByRole('button', { name: 'Edges', exact: true }).click();
  await page.getByLabel('Edge length painted').fill('2');
  await page.getByLabel('Radius of the brush').fill('9');
  const bare = await sampled(page, 'axial');
  await stroke(page, [0.3, 0.4], [0.4, 0.6]);
  await expect(page.getByLabel('Painted edge length 1')).toHaveValue('2');
  const painted = await sampled(page, 'axial');
  expect(painted).not.toEqual(bare);
  await page.getByLabel('Edge length painted').fill('3');
  await stroke(page, [0.6, 0.5], [0.7, 0.6]);
  await expect(page.getByLabel('Painted edge length 2')).toHaveValue('3');
  const both = await sampled(page, 'axial');

  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(page.getByLabel('Painted edge length 2')).toHaveCount(0);
  expect(await sampled(page, 'axial')).toEqual(painted);
  await page.getByRole('button', { name: 'Redo' }).click();
  await expect(page.getByLabel('Painted edge length 2')).toHaveValue('3');
  expect(await sampled(page, 'axial')).toEqual(both);

  await page.getByRole('button', { name: 'Erase', exact: true }).click();
  await page.getByLabel('Radius of the brush').fill('30');
  await stroke(page, [0.6, 0.5], [0.7, 0.6]);
  await expect(page.getByLabel('Painted edge length 2')).toHaveCount(0);
  await page.getByRole('button', { name: 'Stop painting' }).click();

  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await expect.poll(() => smallest(page)).toBe(2);
  await page.waitForTimeout(1500);
  await page.goto('about:blank');
  await page.goto('./');
  await expect(page.getByLabel('Painted edge length 1')).toHaveValue('2');
  await page.getByTestId('run').click();
  await meshed(page);
  expect(await smallest(page)).toBe(2);
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByRole('dialog')).toContainText('painted.nrrd is not in the link');
});

test('the brush works by keys alone', async ({ page }) => {
  await open(page, coarse);
  await page.getByRole('button', { name: 'Paint…' }).focus();
  await page.keyboard.press('Enter');
  await slice(page, 'coronal').locator('.pane-surface').focus();
  await page.keyboard.press('Enter');
  await expect(page.getByLabel('Painted edge length 1')).toBeVisible();
  await page.getByRole('button', { name: 'Remove what is painted with 1 mm' }).click();
  await expect(page.getByLabel('Painted edge length 1')).toHaveCount(0);
});

test('a mask and an image of sizes are dropped on the case; a link of it waits for them by name', async ({
  page,
  browser,
}) => {
  await open(page, coarse);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await dropFile(page, sizeImage('sizes.nii', 4));
  await page.getByRole('button', { name: /Image of sizes/ }).click();
  await expect.poll(() => smallest(page)).toBe(4);
  await dropFile(page, maskFile('box.nrrd'));
  await page.getByRole('button', { name: /Mask of sizes/ }).click();
  await page.getByRole('button', { name: 'box.nrrd 3 mm', exact: true }).click();
  await page.getByLabel('box.nrrd: Edge in label 7').fill('2.5');
  await expect.poll(() => smallest(page)).toBe(2.5);

  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByRole('dialog')).toContainText('box.nrrd, sizes.nii are not in the link');
  const shared = page.getByTestId('share-link');
  await expect(shared).toHaveValue(/#c1=/);
  const url = await shared.inputValue();
  // Here the page has the files, knows the case as its own, and would not ask.
  const other = await (await browser.newContext()).newPage();
  await other.goto(url);
  await expect(other.getByRole('dialog')).toContainText('box.nrrd, sizes.nii, to be dropped in');
  await other.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(other);
  await expect(other.getByText('drop it in again')).toHaveCount(2);
  await other.getByTestId('run').click();
  await expect(other.getByRole('alert')).toContainText("the file 'box.nrrd' has not been loaded");
  await other.getByRole('button', { name: 'Dismiss' }).click();
  await dropFile(other, sizeImage('sizes.nii', 5));
  await expect(other.getByRole('alert')).toContainText('the case was made with');
  await dropFile(other, sizeImage('sizes.nii', 4));
  await dropFile(other, maskFile('box.nrrd'));
  await expect(other.getByText('drop it in again')).toHaveCount(0);
  await idle(other);
  await other.getByTestId('run').click();
  await meshed(other);
  expect(await smallest(other)).toBe(2.5);
  await other.context().close();
});

test('the colour of a label is undone and redone, and kept for the next visit', async ({ page }) => {
  await open(page, coarse);
  const swatch = page.getByLabel('Colour of LV myocardium');
  const before = await swatch.inputValue();
  await swatch.fill('#112233');
  await expect(page.getByRole('button', { name: 'Undo' })).toHaveAttribute('title', 'Undo: Colour of label');
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(swatch).toHaveValue(before);
  await page.getByRole('button', { name: 'Redo' }).click();
  await expect(swatch).toHaveValue('#112233');
  await page.waitForTimeout(1500);
  await page.goto('about:blank');
  await page.goto('./');
  await expect(swatch).toHaveValue('#112233');
});
