/** The heart's excitation on the mesh: set up by hand or by a link, computed, seen, and the same bytes as elsewhere. */
import AxeBuilder from '@axe-core/playwright';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { noValue } from '../src/engine/contract';
import { decodeFragment } from '../src/link/codec';
import { expect, idle, openAndRun, pixels, smallHeart, test } from './support';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');

/** Two ventricles without scar, so that every point has a value. */
const heart = {
  source: smallHeart.source,
  labels: [1, 2],
  merge: [],
  sizing: { edge_mm: 6 },
  physics: {
    anatomy: {},
    fibres: {},
    tissue: { kinds: [{ labels: [1, 2], along_mm_per_ms: 0.6, across_mm_per_ms: 0.3 }] },
    stimuli: [{ name: 'apex', centre_mm: [0, 0, -40], radius_mm: 15 }],
    monodomain: { integration: 'explicit', end_ms: 700, step_ms: 0.1, frame_ms: 10 },
  },
};

interface Told {
  frames: Float32Array[];
  found: Record<string, Float32Array>[];
}

/** Keeps the values that the worker tells: frames, and what was found in the end. */
async function listen(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const told: Told = { frames: [], found: [] };
    Object.assign(window, { told });
    for (const kind of [MessagePort, Worker]) {
      const add = kind.prototype.addEventListener;
      kind.prototype.addEventListener = function (this: EventTarget, ...all: Parameters<typeof add>) {
        add.call(this as Worker, 'message', (event) => {
          const { data } = event as MessageEvent;
          const frame = data?.argumentList?.[0]?.value?.values?.voltage_mV;
          const found = data?.value?.value?.values;
          if (frame) told.frames.push(frame);
          if (found?.eikonal_ms || found?.activation_ms) told.found.push(found);
        });
        return add.apply(this as Worker, all);
      } as typeof add;
    }
  });
}

/** SHA-256 of all frames, if any were told, and of what was found last, from this field on; NaN where points have none. */
function digestInPage(page: Page, firstField: string): Promise<string> {
  return page.evaluate(
    async ([first, none]) => {
      const { frames, found } = (window as unknown as { told: Told }).told;
      const last = Object.entries(found.at(-1)!);
      const gap = Math.fround(none);
      const own = last
        .slice(last.findIndex(([name]) => name === first))
        .map(([, values]) => values.map((value) => (value === gap ? NaN : value)));
      const all = await new Blob([...frames, ...own] as Float32Array<ArrayBuffer>[]).arrayBuffer();
      const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', all));
      return [...digest].map((byte) => byte.toString(16).padStart(2, '0')).join('');
    },
    [firstField, noValue] as const,
  );
}

function digestUnderNode(path: string, stage: string): string {
  const program = join(root, 'build/wasm/voxtet.mjs');
  const report = execFileSync(process.execPath, [program, 'simulate', path, '--what', stage, '--json'], {
    encoding: 'utf8',
    maxBuffer: 1 << 26,
    stdio: ['ignore', 'pipe', 'ignore'],
  });
  return JSON.parse(report).stages.find(({ name }: { name: string }) => name === stage).digest;
}

const colourBy = (page: Page) => page.getByLabel('Colour by');
const player = (page: Page) => page.locator('.player');

test('a link brings a simulation: its activation map and its two waves have the bytes of the command line', async ({
  page,
}, testInfo) => {
  await listen(page);
  const [apex] = heart.physics.stimuli;
  const monodomain = { ...heart.physics.monodomain, end_ms: 1400 };
  const stimuli = [{ ...apex, count: 2, interval_ms: 700 }];
  const twice = { ...heart, physics: { ...heart.physics, stimuli, monodomain } };
  await openAndRun(page, twice);
  const path = testInfo.outputPath('case.json');
  writeFileSync(path, JSON.stringify(twice));
  await page.getByTestId('activation-map').click();
  await expect(page.locator('.legend')).toContainText('Activation time, eikonal');
  await idle(page);
  expect(await digestInPage(page, 'eikonal_ms')).toBe(digestUnderNode(path, 'eikonal'));

  await page.getByTestId('simulate-wave').click();
  await expect(player(page)).toHaveAttribute('data-state', 'done');
  await idle(page);
  await expect(player(page)).toHaveAttribute('data-frames', '141');
  await expect(page.locator('.legend')).toContainText('Membrane voltage');
  expect(await digestInPage(page, 'activation_ms')).toBe(digestUnderNode(path, 'monodomain'));
  // What was found stands in the menu beside what is played.
  await colourBy(page).selectOption({ label: 'Activation time' });
  await expect(page.locator('.legend')).toContainText('Activation time ms');
  const beat = page.getByLabel('Beat', { exact: true });
  await beat.fill('2');
  await expect(page.locator('.legend')).toContainText('Activation time (beat 2) ms, lines every');
  await expect(colourBy(page)).toHaveValue('activation_2_ms');
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')).toEqual([]);
  await colourBy(page).selectOption({ label: 'Action potential duration' });
  await expect(beat).toHaveCount(0);
});

test('a simulation is set up by hand: scar conducts nothing, a stimulus off the heart is told', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Simulate', exact: true }).click();
  const section = page.locator('.section', { has: page.getByRole('heading', { name: 'Physics' }) });
  await expect(section.getByRole('button', { name: 'Stimulus 1', exact: false }).first()).toBeVisible();
  await page.getByTestId('activation-map').click();
  await expect(page.locator('.legend')).toContainText('Activation time, eikonal');
  await idle(page);

  await section.locator('.region-name', { hasText: 'Stimulus 1' }).click();
  const centre = section.locator('.vector-field, .field', { hasText: 'Centre' }).locator('input').first();
  await centre.fill('300');
  await page.getByTestId('activation-map').click();
  await expect(page.getByRole('alert')).toContainText('found no point of conducting tissue in its region');
  await idle(page);
  // The mesh is there still, and undo brings the stimulus back.
  await expect(page.getByTestId('tets')).toBeVisible();
  await page.getByRole('button', { name: 'Undo' }).click();
  await page.getByTestId('activation-map').click();
  await idle(page);
});

test('fibres are drawn as glyphs and as lines, within an outline of the heart, and follow the cut', async ({
  page,
}) => {
  await openAndRun(page, heart);
  const fibres = page.getByLabel('Fibres', { exact: true });
  await fibres.selectOption('glyphs');
  await expect(page.locator('.legend')).toContainText('Helix angle');
  await idle(page);
  const places = Array.from({ length: 400 }, (_, i) => ({
    x: 500 + 15 * (i % 20),
    y: 250 + 15 * Math.floor(i / 20),
  }));
  const coloured = async () =>
    (await pixels(page, places)).filter(([r, g, b]) => Math.max(r, g, b) - Math.min(r, g, b) > 40).length;
  await expect.poll(coloured).toBeGreaterThan(40);
  const whole = await coloured();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await expect.poll(coloured).toBeLessThan(whole);
  await fibres.selectOption('lines');
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await expect.poll(coloured).toBeGreaterThan(40);
  await page.getByRole('button', { name: 'See through' }).click();
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')).toEqual([]);
  await fibres.selectOption('none');
  await expect(page.locator('.legend')).toHaveCount(0);
});

test('a stimulus is dragged on a slice like a region, and its card follows', async ({ page }) => {
  await openAndRun(page, heart);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  const section = page.locator('.section', { has: page.getByRole('heading', { name: 'Physics' }) });
  await section.locator('.region-name', { hasText: 'apex' }).click();
  await section.getByRole('button', { name: 'To the crosshair' }).first().click();
  const right = section.getByLabel('Centre R');
  const before = Number(await right.inputValue());
  const body = (await page.locator('.pane.axial path.is-stimulus.chosen').boundingBox())!;
  const [x, y] = [body.x + body.width / 2, body.y + body.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y, { steps: 4 });
  await page.mouse.up();
  await expect(page.getByRole('button', { name: 'Undo' })).toHaveAttribute('title', 'Undo: Move stimulus');
  expect(Math.abs(Number(await right.inputValue()) - before)).toBeGreaterThan(3);
  await section.getByLabel('Shape').selectOption('box');
  await expect(section.getByRole('group', { name: 'Handle in the view' })).toContainText('Turn');
});

test('a click on the heart excites it while its wave is computed, and the case gives the same from its start', async ({
  page,
}, testInfo) => {
  await listen(page);
  const { monodomain } = heart.physics;
  // Long enough that every point has recovered, and has a value.
  const fine = { ...monodomain, step_ms: 0.01, end_ms: 1000 };
  await openAndRun(page, { ...heart, physics: { ...heart.physics, monodomain: fine } });
  await page.getByTestId('simulate-wave').click();
  const tool = player(page).getByRole('button', { name: 'Stimulate' });
  // Held before its first frame, a wave could not be stimulated.
  await expect(tool).toBeVisible();
  // While frames come the bar is hardly still, and a fast machine would be done before it is.
  await player(page).getByRole('button', { name: 'Hold' }).dispatchEvent('click');
  await tool.click();
  await expect(tool).toHaveAttribute('aria-pressed', 'true');
  // On a busy machine the view may still be moving when the first click comes.
  await expect(async () => {
    const view = (await page.locator('.pane.model').boundingBox())!;
    await page.mouse.click(view.x + view.width / 2, view.y + 0.6 * view.height);
    const undo = page.getByRole('button', { name: 'Undo' });
    await expect(undo).toHaveAttribute('title', 'Undo: Stimulate here', { timeout: 20_000 });
  }).toPass();
  const section = page.locator('.section', { has: page.getByRole('heading', { name: 'Physics' }) });
  await expect(section.locator('.region-name', { hasText: 'Stimulus 2' })).toBeVisible();
  await page.keyboard.press('s');
  await expect(tool).toHaveAttribute('aria-pressed', 'false');
  await player(page).getByRole('button', { name: 'Go on' }).click();
  await expect(player(page)).toHaveAttribute('data-state', 'done');
  await idle(page);

  const path = testInfo.outputPath('case.json');
  writeFileSync(path, JSON.stringify(await decodeFragment(await page.evaluate(() => location.hash))));
  expect(await digestInPage(page, 'activation_ms')).toBe(digestUnderNode(path, 'monodomain'));
});

test('the phase of a wave is played, and a second wave is compared with the pinned one', async ({ page }) => {
  await openAndRun(page, heart);
  await page.getByTestId('simulate-wave').click();
  await expect(player(page)).toHaveAttribute('data-state', 'done');
  await idle(page);
  await colourBy(page).selectOption({ label: 'Phase' });
  await expect(page.locator('.legend')).toContainText('front');
  await page.getByRole('button', { name: 'Pin this run' }).click();
  await expect(page.getByTestId('simulated-differences')).toHaveCount(0);

  const section = page.locator('.section', { has: page.getByRole('heading', { name: 'Physics' }) });
  await section.locator('.region-name', { hasText: 'myocardium' }).click();
  await section.getByLabel('Speed across').fill('0.5');
  await page.getByTestId('simulate-wave').click();
  await expect(page.getByTestId('simulated-differences')).toContainText('Activation time');
  await idle(page);
  await page.getByTestId('simulated-differences').getByRole('button', { name: 'Activation time' }).click();
  await expect(page.locator('.legend')).toContainText('Difference of activation time');
  await expect(page.locator('.changes')).toContainText('Physics: speed across, number 2');
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')).toEqual([]);
  await colourBy(page).selectOption({ label: 'Difference of membrane voltage' });
  await page.keyboard.press(',');
  await expect(page.locator('.legend')).toContainText('Difference of membrane voltage');
});

test('tissue has names: a border zone is slow, and scar is no kind at all', async ({ page }) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Simulate', exact: true }).click();
  const section = page.locator('.section', { has: page.getByRole('heading', { name: 'Physics' }) });
  await section.locator('.region-name', { hasText: 'border zone' }).click();
  const tissue = section.getByLabel('Tissue');
  await expect(tissue).toHaveValue('border');
  const speed = section.getByLabel('border zone: Speed');
  await tissue.selectOption({ label: 'Healthy muscle' });
  await expect(speed).toHaveValue('0.5');
  await tissue.selectOption({ label: 'Border zone, slow and brief' });
  await expect(speed).toHaveValue('0.16');
  await speed.fill('0.2');
  await expect(tissue).toHaveValue('own');
  await tissue.selectOption({ label: 'Scar: conducts nothing' });
  await expect(section.getByText('Conduct nothing: scar core, border zone.')).toBeVisible();
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(section.getByText('Conduct nothing: scar core.')).toBeVisible();
});
