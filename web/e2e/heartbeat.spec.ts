/** A heart that beats: computed on its mesh, played, held, cancelled, drawn as loops, held against an earlier run. */
import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, idle, openAndRun, pixels, test } from './support';

/** One layer of wall, one short beat: some seconds of one core. */
const heart = {
  source: { phantom: { kind: 'biventricle', spacing_mm: [3, 3, 3] } },
  labels: [1, 2],
  merge: [[1, 2]],
  sizing: {
    edge_mm: 16,
    thickness: [{ wall: [1, 2], inner: [3, 4], layers: 1, layering: 'exact' }],
  },
};
const beat = {
  contraction: { by: 'synchronous', start_ms: 50 },
  beats: 1,
  period_ms: 500,
  fill_ms: 100,
  step_ms: 10,
  frame_ms: 20,
};
const beating = { ...heart, physics: { anatomy: {}, fibres: {}, mechanics: beat } };

const player = (page: Page) => page.getByRole('group', { name: 'Player' });
const loops = (page: Page) => page.getByRole('img', { name: /ventricle: pressure in kPa over volume in ml/ });
const cursor = (page: Page) => page.getByLabel('Time', { exact: true });
const begin = (page: Page) => page.getByTestId('simulate-beat').click();
const ended = async (page: Page) => {
  await expect(player(page)).toHaveAttribute('data-state', 'done');
  await idle(page);
};

/** Serious and critical findings, as the page is. */
async function faults(page: Page): Promise<unknown[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
}

/** The view as colours on a grid. */
async function seen(page: Page): Promise<string> {
  const box = (await page.locator('.pane.model').boundingBox())!;
  const places = Array.from({ length: 400 }, (_, i) => ({
    x: Math.round(box.x + ((i % 20) + 0.5) * (box.width / 20)),
    y: Math.round(box.y + (Math.floor(i / 20) + 0.5) * (box.height / 20)),
  }));
  return (await pixels(page, places)).join();
}

test('a heart beats: it is held and goes on, its loops come with the frames, and it moves as it is played', async ({
  page,
}) => {
  await openAndRun(page, beating);
  await begin(page);
  await expect(loops(page)).toHaveCount(2);
  await page.getByRole('button', { name: 'Hold' }).click();
  await expect(player(page)).toHaveAttribute('data-state', 'paused');
  await expect(page.getByTestId('last-beat')).toHaveCount(0);
  await page.getByRole('button', { name: 'Go on' }).click();
  await ended(page);
  await expect(player(page)).toHaveAttribute('data-frames', '26');
  await expect(page.locator('.legend')).toContainText('Fibre strain');

  // What the engine found at the end stands below: the ventricle ejects what it loses.
  const figures = page.getByTestId('last-beat');
  const left = async (name: string) =>
    Number(
      await figures
        .getByRole('row', { name: new RegExp(`^${name}`) })
        .getByRole('cell')
        .first()
        .innerText(),
    );
  await expect(figures).toBeVisible();
  expect(await left('EDV')).toBeGreaterThan(await left('ESV'));
  expect(await left('SV')).toBeCloseTo((await left('EDV')) - (await left('ESV')), 0);
  await expect(page.getByTestId('limit-cycle')).toContainText('One beat');

  // The mesh is elsewhere when it has contracted, and where it was when it is shown at rest.
  await page.getByRole('button', { name: 'Edges' }).click();
  await page.getByLabel('Colour by').selectOption({ label: 'Label' });
  await cursor(page).fill('0');
  const filled = await seen(page);
  await cursor(page).fill('250');
  await expect.poll(() => seen(page)).not.toBe(filled);
  const contracted = await seen(page);
  await page.getByLabel('Motion').selectOption('rest');
  await expect.poll(() => seen(page)).not.toBe(contracted);
  const atRest = await seen(page);
  await page.getByLabel('Motion').selectOption('moved');
  await expect.poll(() => seen(page)).toBe(contracted);
  await page.getByRole('button', { name: /^Smooth/ }).click();
  await expect(page.getByLabel('Colour by')).toBeVisible();
  await page.getByRole('button', { name: /^Quality/ }).click();
  expect(atRest).not.toBe(filled);

  for (const field of ['Wall thickening', 'Active stress', 'Displacement']) {
    await page.getByLabel('Colour by').selectOption({ label: field });
    await expect(page.locator('.legend')).toContainText(field);
  }

  // A place of the loop is a time.
  const loop = loops(page).first();
  await loop.scrollIntoViewIfNeeded();
  const box = (await loop.boundingBox())!;
  await page.mouse.click(box.x + 0.17 * box.width, box.y + 0.4 * box.height);
  const time = Number(await cursor(page).inputValue());
  expect(time).toBeGreaterThan(100);
  expect(time).toBeLessThan(480);
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    await expect(page.locator('html')).toHaveAttribute('data-theme', colorScheme);
    expect(await faults(page)).toEqual([]);
  }

  const file = page.waitForEvent('download');
  await page.getByRole('button', { name: 'CSV' }).click();
  expect((await file).suggestedFilename()).toMatch(/\.heartbeat\.csv$/);
});

test('a run is kept by a name, and a later one is drawn over it', async ({ page }) => {
  await openAndRun(page, beating);
  await begin(page);
  await ended(page);
  await page.getByLabel('Name of this run').fill('healthy');
  await page.getByRole('button', { name: 'Keep this run' }).click();
  await expect(loops(page).first()).toHaveAccessibleName(/beside 1 kept/);
  await page.getByLabel('Heartbeat: Pulmonary leak').fill('0.4');
  await begin(page);
  await ended(page);
  const table = page.getByTestId('kept-runs');
  await expect(table.getByRole('row')).toHaveCount(3);
  await expect(table.getByLabel(/Name of kept run/)).toHaveValue('healthy');
  const [now, before] = await Promise.all(
    [1, 2].map((row) => table.getByRole('row').nth(row).getByRole('cell').nth(1).innerText()),
  );
  // Only the right ventricle's valve leaks.
  expect(now).not.toBe(before);
  await table.getByRole('button', { name: 'Remove healthy' }).click();
  await expect(table).toHaveCount(0);
});

test('a heartbeat is added by hand with what it needs, and cancelled without losing the mesh', async ({
  page,
}) => {
  await openAndRun(page, heart);
  await page.getByRole('button', { name: 'Heartbeat', exact: true }).click();
  const section = page.getByTestId('heartbeat');
  await expect(section.getByLabel('Activated by')).toHaveValue('synchronous');
  await page.getByLabel('Heartbeat: Step').fill('10');
  await begin(page);
  await expect(player(page)).toContainText('filling');
  await expect(loops(page)).toHaveCount(2);
  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect(player(page)).toHaveAttribute('data-state', 'cancelled');
  await idle(page);
  await expect(page.getByTestId('tets')).toBeVisible();
  await expect(loops(page)).toHaveCount(2);
  // The map of activation needs tissue and a stimulus: they come with it.
  await section.getByLabel('Activated by').selectOption('eikonal');
  await expect(page.getByTestId('activation-map')).toBeVisible();
  await section.getByRole('button', { name: 'Remove heartbeat' }).click();
  await expect(page.getByTestId('simulate-beat')).toHaveCount(0);
});

test('a mesh without cavities is told of', async ({ page }) => {
  const ball = { source: { phantom: { kind: 'sphere' } }, sizing: { edge_mm: 8 } };
  await openAndRun(page, ball);
  await page.getByRole('button', { name: 'Heartbeat', exact: true }).click();
  await begin(page);
  await expect(page.getByRole('alert')).toContainText(/cavit|ventricle|label/i);
  await idle(page);
  await expect(page.getByTestId('tets')).toBeVisible();
});
