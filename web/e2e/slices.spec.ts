/** Slices: there before the surface is, with the mesh on them, zoomed by buttons, wheel and fingers. */
import type { Page } from '@playwright/test';
import { labelledFile } from './files';
import { dropFile, expect, idle, link, openAndRun, pixels, slice, smallHeart, stage, test } from './support';

/** Two balls in one another, of so many voxels that the surface takes a while. */
const balls = () =>
  labelledFile('balls.nrrd', [96, 96, 96], [1, 1, 1], (i, j, k) => {
    const away = Math.hypot(i - 47.5, j - 47.5, k - 47.5);
    return away < 20 ? 2 : away < 40 ? 1 : 0;
  });

const panes = (page: Page) => page.locator('.panes');
const surface = (page: Page, name: string) => slice(page, name).locator('.pane-surface');

async function placeIn(page: Page, name: string, x: number, y: number) {
  const box = (await surface(page, name).boundingBox())!;
  return { x: Math.round(box.x + x * box.width), y: Math.round(box.y + y * box.height) };
}

/** The millimetres that a pane's head tells. */
const mm = async (page: Page, name: string) =>
  Number(
    /(-?[\d.]+) mm/.exec((await slice(page, name).locator('.pane-place').innerText()).replace('−', '-'))![1],
  );

async function openHeart(page: Page): Promise<void> {
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  // Panes learn of their size with a frame.
  await page.evaluate(
    () => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))),
  );
}

test('a dropped volume is read, then seen in slices, and its surface only then', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  const seen = await page.evaluateHandle(() => {
    const texts: string[] = [];
    new MutationObserver(() => {
      const parts = ['.reading h1', '.empty h1', '.surface-note'].map((one) => document.querySelector(one));
      const layout = document.querySelector('.view')?.getAttribute('data-layout');
      const text = [...parts.map((part) => part?.textContent ?? ''), layout ?? ''].join('|');
      if (texts.at(-1) !== text) texts.push(text);
    }).observe(document.body, { subtree: true, childList: true, attributes: true });
    return texts;
  });
  await dropFile(page, balls());
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(panes(page)).toHaveAttribute('data-layout', 'model');
  const texts = await seen.jsonValue();
  const first = (like: RegExp) => texts.findIndex((text) => like.test(text));
  expect(first(/^Reading balls\.nrrd…\|/)).toBeGreaterThan(-1);
  expect(first(/surface is being made.*\|slices$/)).toBeGreaterThan(first(/^Reading balls\.nrrd…\|/));
  // Nothing of the empty page once there is something to wait for.
  expect(texts.slice(first(/^Reading/)).filter((text) => text.split('|')[1] !== '')).toEqual([]);
});

test('slices stay for whoever works on them, and tell the label under the pointer', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  await dropFile(page, balls());
  const label = slice(page, 'axial').locator('.pane-label');
  await expect(label).toHaveText('label 2');
  await expect(panes(page)).toHaveAttribute('data-layout', 'slices');
  const middle = await placeIn(page, 'axial', 0.5, 0.5);
  const marked = page.locator('.picked-label');
  // The first press may come before the panes have their sizes.
  await expect(async () => {
    await page.mouse.click(middle.x, middle.y);
    await expect(marked).toContainText('33,552', { timeout: 500 });
  }).toPass();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await expect(panes(page)).toHaveAttribute('data-layout', 'slices');
  const { x, y } = await placeIn(page, 'axial', 0.5, 0.25);
  await page.mouse.move(x, y);
  await expect(label).toHaveText('label 1');
  await expect(slice(page, 'coronal').locator('.pane-label')).toHaveText('label 2');
  await page.getByLabel('Mesh label 1').uncheck();
  await page.mouse.move(x, y + 1);
  await expect(label).toHaveText('label 1, not meshed');
  await page.mouse.click(x, y);
  await expect(marked.getByLabel('Name of label 1')).toBeVisible();
  await page.getByRole('button', { name: '3-D', exact: true }).click();
  await expect(panes(page)).toHaveAttribute('data-layout', 'model');
});

test('a slice is zoomed by buttons, keys and the wheel about the pointer, and fitted again', async ({
  page,
}) => {
  await openHeart(page);
  const { x, y } = await placeIn(page, 'axial', 0.75, 0.5);
  const at = async () => {
    await page.mouse.click(x, y);
    return mm(page, 'sagittal');
  };
  const whole = await at();
  const button = (name: RegExp) => slice(page, 'axial').getByRole('button', { name });
  await button(/Zoom in/).click();
  await button(/Zoom in/).click();
  const near = await at();
  expect(Math.abs(near)).toBeLessThan(0.8 * Math.abs(whole));
  await button(/Zoom out/).click();
  expect(Math.abs(await at())).toBeGreaterThan(Math.abs(near));
  await button(/The whole slice/).click();
  await expect.poll(at).toBe(whole);
  // What is under the pointer stays there.
  await page.keyboard.down('Control');
  await page.mouse.wheel(0, -300);
  await page.keyboard.up('Control');
  expect(await at()).toBe(whole);
  await page.mouse.click(x - 60, y);
  expect(Math.abs((await mm(page, 'sagittal')) - whole)).toBeGreaterThan(0);
  await expect(slice(page, 'axial').locator('.pane-hint')).toBeHidden();
});

test('borders of the mesh are on the slices with and without the edges of elements', async ({ page }) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  const picture = async () => {
    await page.waitForTimeout(400);
    return (await slice(page, 'axial').screenshot()).toString('base64');
  };
  const withEdges = await picture();
  await page.getByRole('button', { name: 'Edges', exact: true }).click();
  const borders = await picture();
  expect(borders).not.toBe(withEdges);
  await stage(page, 'volume').click();
  expect(await picture()).not.toBe(borders);
});

test('target edge lengths are shown where a mesh will be, and labels stay pale around it', async ({
  page,
}) => {
  await openHeart(page);
  const middle = await placeIn(page, 'axial', 0.47, 0.47);
  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await expect(page.locator('.scale-strip')).toContainText('mm');
  await page.waitForTimeout(400);
  // The blood pool, blue, is not meshed; the longest edges would be yellow.
  const [[red, , blue]] = await pixels(page, [middle]);
  expect(blue).toBeGreaterThan(red);
});

test('painting where nothing is meshed is said', async ({ page }) => {
  await openHeart(page);
  await page.getByRole('button', { name: 'Paint…' }).click();
  await surface(page, 'axial').click();
  await expect(page.getByText('LV blood pool is not meshed')).toBeVisible();
  await expect(page.getByTestId('forecast')).toContainText('(as before)');
});

test.describe('by touch', () => {
  test.use({ hasTouch: true });

  test('one finger moves the crosshair; two zoom and shift the slice, and leave it', async ({ page }) => {
    await openHeart(page);
    const client = await page.context().newCDPSession(page);
    const { x, y } = await placeIn(page, 'axial', 0.5, 0.5);
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: [number, number][]) =>
      client.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: points.map(([dx, dy], id) => ({ x: x + dx, y: y + dy, id })),
      });
    const tap = async (dx: number) => {
      await touch('touchStart', [dx, 0]);
      await touch('touchEnd');
      return mm(page, 'sagittal');
    };
    const left = await tap(-60);
    await touch('touchStart', [-60, 0]);
    await touch('touchMove', [-20, 0]);
    await touch('touchMove', [60, 0]);
    await touch('touchEnd');
    const right = await mm(page, 'sagittal');
    expect(Math.sign(left)).toBe(-Math.sign(right));

    await touch('touchStart', [-30, 0]);
    await touch('touchStart', [-30, 0], [30, 0]);
    for (const reach of [40, 50, 60]) await touch('touchMove', [-reach, 0], [reach, 0]);
    await touch('touchEnd');
    expect(await mm(page, 'sagittal')).toBe(right);
    const zoomed = await tap(60);
    expect(Math.abs(zoomed)).toBeLessThan(0.7 * Math.abs(right));

    await touch('touchStart', [-30, 0], [30, 0]);
    for (const shift of [20, 40]) await touch('touchMove', [shift - 30, 0], [shift + 30, 0]);
    await touch('touchEnd');
    const shifted = await tap(60);
    expect(Math.abs(shifted - zoomed)).toBeGreaterThan(5);
  });
});
