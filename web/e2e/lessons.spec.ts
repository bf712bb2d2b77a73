/** The lessons that ship with the page, each taken to its last step as a pupil does. */
import type { Page } from '@playwright/test';
import { expect, idle, test } from './support';

const panel = (page: Page) => page.getByRole('region', { name: 'Lesson', exact: true });
const asked = (page: Page) => panel(page).getByTestId('question');

async function begin(page: Page, name: string): Promise<void> {
  await page.goto(`./?lesson=${name}`);
  await panel(page).getByRole('button', { name: 'Start' }).click();
  await expect(panel(page).getByRole('heading', { name: 'Free play' })).toBeVisible();
  await next(page);
}

/** On to the next step; the case that it brings is open. */
async function next(page: Page): Promise<void> {
  await panel(page)
    .getByRole('button', { name: /^(Next|Finish)$/ })
    .click();
  await expect(page.getByTestId('lesson-step')).toHaveAttribute('aria-busy', 'false');
  await idle(page);
}

/** The question is answered, and the lesson goes on. */
async function answered(page: Page): Promise<void> {
  await expect(asked(page)).toHaveAttribute('data-done', 'true');
  await next(page);
}

async function choose(page: Page, text: string | RegExp): Promise<void> {
  await idle(page);
  await asked(page).getByLabel(text).check();
  await asked(page).getByRole('button', { name: 'Check' }).click();
  await answered(page);
}

async function enter(page: Page, value: number | string): Promise<void> {
  await asked(page).getByLabel('Answer').fill(String(value));
  await asked(page).getByRole('button', { name: 'Check' }).click();
  await answered(page);
}

/** A number that the step shows. */
async function shown(page: Page, title: string): Promise<number> {
  const row = panel(page)
    .locator('.findings div')
    .filter({ has: page.locator('dt', { hasText: new RegExp(`^${title}$`) }) });
  await expect(row.locator('dd')).not.toHaveText('–');
  return Number((await row.locator('dd').innerText()).replaceAll(',', '').split(' ')[0]);
}

const run = (page: Page) => page.getByTestId('run').click();
const pin = (page: Page) => page.getByRole('button', { name: /^Pin this run/ }).click();
const edge = (page: Page, mm: number) => page.getByLabel('Edge length', { exact: true }).fill(String(mm));

async function ended(page: Page, questions: number): Promise<void> {
  await expect(page.getByTestId('lesson-end')).toContainText(
    `${questions} of ${questions} questions answered`,
  );
  await panel(page).getByRole('button', { name: 'Leave the lesson' }).last().click();
  await expect(panel(page)).toHaveCount(0);
  await expect(page.getByRole('button', { name: 'Open file…' })).toBeVisible();
}

test('from voxels to a smooth surface', async ({ page }) => {
  await begin(page, 'surface');
  await expect(page.getByRole('heading', { name: 'Element size' })).toHaveCount(0);
  await enter(page, '5026,5');
  expect(await shown(page, 'Area with the staircase')).toBeGreaterThan(1.05 * 5027);
  await choose(page, /larger/);
  await page.getByLabel('Voxel size').fill('1.5');
  await answered(page);
  await choose(page, /as wrong as before/);
  await page.getByLabel('Smoothing: Iterations').fill('20');
  await answered(page);
  await page.getByLabel('Keep volume').uncheck();
  await answered(page);
  await choose(page, /too little/);
  await ended(page, 7);
});

test('what a sizing field is', async ({ page }) => {
  await begin(page, 'sizing');
  await page.getByRole('button', { name: 'Sphere', exact: true }).click();
  await page.getByLabel(/: Edge inside$/).fill('2');
  await answered(page);
  await enter(page, 5);
  await run(page);
  const before = await shown(page, 'Tetrahedra');
  await pin(page);
  await answered(page);
  await page.getByLabel('Growth per mm', { exact: true }).fill('0.1');
  await idle(page);
  await run(page);
  await answered(page);
  await enter(page, ((await shown(page, 'Tetrahedra')) / before).toFixed(2));
  await choose(page, /badly shaped/);
  await ended(page, 6);
});

test('why slivers hurt', async ({ page }) => {
  await begin(page, 'slivers');
  await choose(page, /slightly bent/);
  await run(page);
  const before = await shown(page, 'Condition number of the stiffness matrix');
  await pin(page);
  await answered(page);
  await page.getByLabel('Better shapes: Rounds').fill('0');
  await run(page);
  await answered(page);
  const after = await shown(page, 'Condition number of the stiffness matrix');
  expect(after).toBeGreaterThan(1.5 * before);
  await enter(page, (after / before).toFixed(2));
  await choose(page, /largest eigenvalue larger/);
  await enter(page, 26.7);
  await choose(page, /twice as many/);
  await ended(page, 7);
});

test('many labels, and their topology', async ({ page }) => {
  await begin(page, 'topology');
  await run(page);
  await expect(page.getByTestId('tets')).toBeVisible();
  await enter(page, 1);
  await enter(page, 0);
  await edge(page, 16);
  await run(page);
  await answered(page);
  await choose(page, /still one handle/);
  await run(page);
  await expect(page.getByTestId('tets')).toBeVisible();
  await enter(page, 1);
  await enter(page, 2);
  await page.getByLabel('Mesh the labels as one region').check();
  await idle(page);
  await run(page);
  await answered(page);
  await ended(page, 7);
});

test('layers through a wall', async ({ page }) => {
  await begin(page, 'layers');
  await run(page);
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await answered(page);
  await enter(page, 3);
  await page.getByRole('button', { name: 'Wall', exact: true }).click();
  await page.getByRole('group', { name: 'Size by' }).getByRole('button', { name: 'Layers' }).click();
  await page.getByLabel(/: Elements across$/).fill('2');
  await run(page);
  const exact = await shown(page, 'Area with exactly so many');
  await answered(page);
  await enter(page, exact);
  await pin(page);
  await page.getByRole('button', { name: /2 layers/ }).click();
  await page.getByLabel('Exactly so many').check();
  await run(page);
  await answered(page);
  await choose(page, /^Fewer/);
  await ended(page, 6);
});

test('adaptive against uniform', async ({ page }) => {
  await begin(page, 'adaptive');
  await edge(page, 3.5);
  await run(page);
  const before = await shown(page, 'Tetrahedra');
  await pin(page);
  await answered(page);
  await edge(page, 8);
  await page.getByLabel('Edge length of scar core').fill('3.5');
  await run(page);
  await answered(page);
  await page.getByRole('group', { name: 'Layout' }).getByRole('button', { name: 'Compare' }).click();
  await answered(page);
  const share = (await shown(page, 'Tetrahedra')) / before;
  expect(share).toBeLessThan(0.5);
  await enter(page, share.toFixed(3));
  await choose(page, /^The same/);
  await choose(page, /^8$/);
  await ended(page, 6);
});

test('how a wave goes around a scar', async ({ page }) => {
  await begin(page, 'wave');
  const last = 'Last activation of label 6';
  const map = () => page.getByTestId('activation-map').click();
  const tissue = async (kind: RegExp, preset: string) => {
    await page.getByRole('button', { name: kind }).first().click();
    await page.getByLabel('Tissue', { exact: true }).selectOption(preset);
  };
  await run(page);
  await map();
  await answered(page);
  const before = await shown(page, last);
  await enter(page, (0.6 * before).toFixed(1));
  await pin(page);
  await answered(page);
  await tissue(/^scar core/, 'scar');
  await map();
  await answered(page);
  expect(await shown(page, last)).toBeGreaterThan(1.1 * before);
  await choose(page, /^Later$/);
  await tissue(/^border zone/, 'border');
  await map();
  await answered(page);
  await choose(page, /isthmus/);
  await page.getByTestId('simulate-wave').click();
  await answered(page);
  await ended(page, 8);
});

test('how many layers a beating heart needs', async ({ page }) => {
  test.setTimeout(900_000); // two beats
  await begin(page, 'beat');
  const volume = (which: string) => shown(page, `Left ventricle, ${which} volume`);
  const beaten = async () => {
    await page.getByTestId('simulate-beat').click();
    await expect(asked(page)).toHaveAttribute('data-done', 'true', { timeout: 400_000 });
  };
  await run(page);
  await beaten();
  const [filled, left] = [await volume('end-diastolic'), await volume('end-systolic')];
  await next(page);
  await enter(page, (100 * (1 - left / filled)).toFixed(1));
  const before = await volume('stroke');
  await pin(page);
  await answered(page);
  await page.getByLabel('Elements', { exact: true }).selectOption('p1');
  await beaten();
  expect(await volume('end-diastolic')).toBeLessThan(0.95 * filled);
  const stroke = await volume('stroke');
  expect(stroke).toBeLessThan(0.9 * before);
  await next(page);
  await enter(page, (stroke / before).toFixed(2));
  await choose(page, /^It is less/);
  await choose(page, /hardly more directions/);
  await choose(page, /no longer change/);
  await ended(page, 8);
});
