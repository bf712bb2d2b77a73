/** The 3-D view: the element that is singled out, what colours mean, tools that leave the view where it is. */
import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { countColour, expect, openAndRun, slice, smallHeart, stage, test } from './support';

/** Of outlines, and of nothing else. */
const mark = [255, 0, 184];

async function outlined(page: Page): Promise<number> {
  await page.waitForTimeout(400);
  return countColour(page, await slice(page, 'model').screenshot(), mark);
}

async function brushAngles(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'give a range of angle' }).click();
  await expect(page.getByTestId('brush-count')).toHaveText(/[1-9][\d,]* elements/);
}

const rgbOf = (hex: string) => [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16));

/** The colour of an entry of the key of labels. */
async function keyColour(page: Page, entry: number): Promise<number[]> {
  return rgbOf((await page.locator('.label-key rect').nth(entry).getAttribute('fill'))!);
}

test('an element that is flown to is outlined through everything, with and without a brushed range', async ({
  page,
}) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openAndRun(page, smallHeart);
  expect(await outlined(page)).toBe(0);
  const worst = page.locator('.worst button').first();
  for (const brushed of [false, true])
    for (const colours of ['label', 'min_dihedral_deg']) {
      await page.getByLabel('Colour by').selectOption(colours);
      if (brushed) await brushAngles(page);
      await worst.click();
      const card = page.locator('.picked');
      await expect(card).toContainText('Tetrahedron');
      expect(await outlined(page)).toBeGreaterThan(300);
      // The card leaves the middle free, where the element is.
      const view = (await slice(page, 'model').boundingBox())!;
      const box = (await card.boundingBox())!;
      expect(box.y + box.height).toBeLessThan(view.y + view.height / 2 - 60);
      await page.getByRole('button', { name: 'Close' }).click();
      expect(await outlined(page)).toBe(0);
      // A range that was brushed is what is shown again.
      await expect(page.getByTestId('brush-count')).toHaveCount(brushed ? 1 : 0);
      if (brushed) await page.getByRole('button', { name: 'Show all', exact: true }).click();
    }
});

test('an element or triangle that is clicked is outlined, and its card stands on the other side', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  const surface = slice(page, 'model').locator('.pane-surface');
  const { width, height } = (await surface.boundingBox())!;
  for (const [name, title] of [
    ['quality', 'Tetrahedron'],
    ['remesh', 'Triangle'],
  ]) {
    await stage(page, name).click();
    for (const [x, side] of [
      [0.4, 'right'],
      [0.6, 'left'],
    ] as const) {
      await surface.click({ position: { x: x * width, y: 0.6 * height } });
      await expect(page.locator(`.picked.${side}`)).toContainText(title);
      expect(await outlined(page)).toBeGreaterThan(20);
    }
  }
});

test('a scale has round ticks, says where values lie beyond it, and the bad end is the loudest', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByLabel('Colour by').selectOption('min_dihedral_deg');
  const legend = page.locator('.legend');
  await expect(legend.locator('.legend-tick')).not.toHaveCount(0);
  const ticks = (await legend.locator('g text').allTextContents()).map(Number);
  expect(ticks.length).toBeGreaterThan(2);
  for (const tick of ticks) expect(tick % 5).toBe(0);
  await expect(legend.locator('.legend-clip').first()).toHaveText('<');
  // The least angle of all is told by the evidence and by the legend.
  const told = await page.locator('.panel.right').innerText();
  const least = /Smallest angle\s+([\d.]+)°/.exec(told)![1];
  await expect(legend.locator('.legend-range')).toContainText(new RegExp(`^${least}`));
  await expect(legend).toHaveAttribute('aria-label', new RegExp(`values from ${least}`));
  await expect(legend.locator('.legend-spread')).toHaveCount(1);
  const stops = await legend
    .locator('stop')
    .evaluateAll((all) => all.map((stop) => stop.getAttribute('stop-color')!));
  const chroma = (hex: string) => {
    const parts = rgbOf(hex);
    return Math.max(...parts) - Math.min(...parts);
  };
  expect(Math.max(...stops.map(chroma))).toBe(chroma(stops[0]));
});

test('labels are named below the body, but for hidden ones and where there is no room', async ({ page }) => {
  await openAndRun(page, smallHeart);
  const key = page.getByRole('list', { name: 'Labels', exact: true });
  await expect(key).toContainText('LV myocardium');
  await expect(key.locator('li')).toHaveCount(4);
  await page.getByRole('button', { name: 'Show LV myocardium in the view' }).click();
  await expect(key).not.toContainText('LV myocardium');
  await page.getByLabel('Colour by').selectOption('edge_mm');
  await expect(key).toHaveCount(0);
  await page.getByLabel('Colour by').selectOption('label');
  await stage(page, 'remesh').click();
  await expect(key).toContainText('RV myocardium');
  await page.setViewportSize({ width: 420, height: 800 });
  await expect(key).toBeHidden();
});

test('layers of a wall are told apart, from the inner one outwards', async ({ page }) => {
  const thickness = [{ wall: [1, 2], inner: [3, 4], layers: 3, layering: 'exact' }];
  await openAndRun(page, {
    source: { phantom: { kind: 'biventricle', spacing_mm: [3, 3, 3] } },
    labels: [1, 2],
    merge: [[1, 2]],
    sizing: { edge_mm: 10, thickness },
  });
  await page.getByLabel('Colour by').selectOption('layer');
  const legend = page.locator('.legend');
  await expect(legend.locator('.legend-box')).toHaveCount(3);
  await expect(legend.locator('g text')).toHaveText(['1', '2', '3']);
  await page.getByRole('button', { name: 'Edges', exact: true }).click();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await page.getByRole('button', { name: 'Flat', exact: true }).click();
  await page.getByRole('button', { name: 'Cut from head to feet' }).click();
  await page.getByRole('button', { name: "View from the patient's head" }).click();
  await page.waitForTimeout(1500);
  const picture = await slice(page, 'model').screenshot();
  const boxes = await legend
    .locator('.legend-box')
    .evaluateAll((all) => all.map((box) => box.getAttribute('fill')!));
  for (const hex of boxes) {
    expect(await countColour(page, picture, rgbOf(hex), 6)).toBeGreaterThan(2000);
  }
});

test('the face of a flat cut has the colours of its labels, and what lies behind it is darker', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Edges', exact: true }).click();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await page.getByRole('button', { name: 'Flat', exact: true }).click();
  await page.getByRole('button', { name: "View from the patient's front" }).click();
  await page.waitForTimeout(1500);
  const picture = await slice(page, 'model').screenshot();
  const wall = await keyColour(page, 0);
  expect(await countColour(page, picture, wall, 2)).toBeGreaterThan(5000);
  const shaded = wall.map((part) => 0.65 * part);
  expect(await countColour(page, picture, shaded, 18)).toBeGreaterThan(5000);
});

test('neither a cut nor a pinned run moves the view or a tool', async ({ page }) => {
  await openAndRun(page, smallHeart);
  const places = async () =>
    Promise.all(
      [
        page.locator('.view-canvas'),
        page.getByRole('button', { name: 'Edges', exact: true }),
        page.getByRole('button', { name: 'Cut', exact: true }),
        page.getByRole('button', { name: 'Fit to view' }),
        page.getByLabel('Colour by'),
      ].map((part) => part.boundingBox()),
    );
  const before = await places();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await expect(page.getByLabel('Place of the cut')).toBeVisible();
  expect(await places()).toEqual(before);
  await page.getByRole('button', { name: 'Pin this run' }).click();
  await expect(page.getByRole('button', { name: 'Compare', exact: true })).toBeEnabled();
  expect(await places()).toEqual(before);
});

test('a double click on the body or on a slice puts a sphere there, with its fields in sight', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  const surface = slice(page, 'model').locator('.pane-surface');
  const { width, height } = (await surface.boundingBox())!;
  const position = { x: 0.5 * width, y: 0.6 * height };
  await surface.click({ position });
  const at = page.locator('.picked dl > div', { hasText: /^At/ }).locator('dd');
  const hit = (await at.innerText()).replaceAll('−', '-').split(',').map(Number.parseFloat);
  await surface.dblclick({ position });
  await expect(page.getByLabel('Region name')).toHaveValue('Region 1');
  const card = page.locator('.region.open');
  await expect(card).toBeInViewport({ ratio: 0.95 });
  const centre = page.getByLabel(/^Centre/);
  const first = await centre.evaluateAll((all) => all.map((one) => (one as HTMLInputElement).value));
  expect(first.map(Number)).toEqual(hit);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  const axial = slice(page, 'axial').locator('.pane-surface');
  const box = (await axial.boundingBox())!;
  await axial.dblclick({ position: { x: 0.3 * box.width, y: 0.4 * box.height } });
  await expect(page.getByLabel('Region name')).toHaveValue('Region 2');
  await expect(card).toBeInViewport({ ratio: 0.95 });
  const second = await centre.evaluateAll((all) => all.map((one) => (one as HTMLInputElement).value));
  expect(second).not.toEqual(first);
});

test('a saved picture has the directions of the patient and what the colours mean', async ({ page }) => {
  await openAndRun(page, smallHeart);
  const save = async () => {
    const downloading = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save a picture of the view' }).click();
    return readFile(await (await downloading).path());
  };
  const labelled = await save();
  const discs = await page
    .locator('.triad-end.plus circle')
    .evaluateAll((all) => all.map((disc) => getComputedStyle(disc).fill.match(/\d+/g)!.map(Number)));
  // Of some 900 pixels of a disc the letter and the rim are others.
  for (const disc of discs) expect(await countColour(page, labelled, disc, 1)).toBeGreaterThan(200);
  // The scar lies inside: its colour is in the key alone.
  const scar = await keyColour(page, 2);
  expect(await countColour(page, labelled, scar, 1)).toBeGreaterThan(200);
  await page.getByLabel('Colour by').selectOption('radius_ratio');
  const bad = rgbOf((await page.locator('.legend stop').first().getAttribute('stop-color'))!);
  const scaled = await save();
  // Some 150 pixels of the scale; how many the body has depends on the mesh.
  expect(await countColour(page, labelled, bad, 8)).toBeLessThan(50);
  expect(await countColour(page, scaled, bad, 8)).toBeGreaterThan(100);
  expect(await countColour(page, scaled, scar, 1)).toBe(0);
});
