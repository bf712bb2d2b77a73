/** A result that lives in time: computed on the mesh, played, held, cancelled without losing the mesh. */
import AxeBuilder from '@axe-core/playwright';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { gallery } from '../src/store/case/gallery';
import { expect, idle, meshed, stage, test, tetCount } from './support';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');

interface Watched {
  /** Milliseconds of every task of the page that took more than 50. */
  longTasks: number[];
  /** Stages that the engine has told progress of. */
  stages: string[];
  /** Values of the frames that it has sent. */
  frames: Float32Array[];
}

/** Notes long tasks of the page, and what the engine's worker says by the ports of its callbacks. */
async function watch(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const watched: Watched = { longTasks: [], stages: [], frames: [] };
    Object.assign(window, { watched });
    new PerformanceObserver((list) => {
      for (const { duration } of list.getEntries()) watched.longTasks.push(duration);
    }).observe({ type: 'longtask' });
    const listen = MessagePort.prototype.addEventListener;
    MessagePort.prototype.addEventListener = function (this: MessagePort, ...all: Parameters<typeof listen>) {
      listen.call(this, 'message', (event) => {
        const [first] = (event as MessageEvent).data?.argumentList ?? [];
        if (typeof first?.value === 'string') watched.stages.push(first.value);
        if (first?.value?.values) watched.frames.push(first.value.values.temperature);
      });
      return listen.apply(this, all);
    } as typeof listen;
  });
}

/** SHA-256 of the values of all frames that the page was given. */
function framesDigest(page: Page): Promise<string> {
  return page.evaluate(async () => {
    const { frames } = (window as unknown as { watched: Watched }).watched;
    const all = await new Blob(frames as Float32Array<ArrayBuffer>[]).arrayBuffer();
    const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', all));
    return [...digest].map((byte) => byte.toString(16).padStart(2, '0')).join('');
  });
}

/** The same of the command line, as WebAssembly. */
function digestUnderNode(path: string): string {
  const options = ['mesh', path, '--until', 'diffusion', '--json'];
  const report = execFileSync(process.execPath, [join(root, 'build/wasm/voxtet.mjs'), ...options], {
    encoding: 'utf8',
    maxBuffer: 1 << 26,
    stdio: ['ignore', 'pipe', 'ignore'],
  });
  return JSON.parse(report).stages.at(-1).digest;
}

const watched = (page: Page) =>
  page.evaluate(() => {
    const { longTasks, stages } = (window as unknown as { watched: Watched }).watched;
    return { longTasks, stages };
  });
const forget = (page: Page) =>
  page.evaluate(() => {
    const { longTasks, stages, frames } = (window as unknown as { watched: Watched }).watched;
    longTasks.length = stages.length = frames.length = 0;
  });

/**
 * Milliseconds of the processor that the longest task of the page took, by a trace. What the test itself asks of the page
 * does not count, nor what a task waits for on a busy machine.
 */
function longestTask(trace: Buffer): number {
  interface Entry {
    name: string;
    pid: number;
    tid: number;
    ts: number;
    dur: number;
    tdur?: number;
    args: { name?: string; chrome_mojo_event_info?: { mojo_interface_tag?: string } };
  }
  const { traceEvents: all } = JSON.parse(trace.toString()) as { traceEvents: Entry[] };
  const thread = ({ pid, tid }: Entry) => `${pid} ${tid}`;
  const pages = new Set(all.filter(({ args }) => args.name === 'CrRendererMain').map(thread));
  const asked = all.filter(({ args }) =>
    args.chrome_mojo_event_info?.mojo_interface_tag?.includes('DevTools'),
  );
  const tasks = all.filter(
    (task) =>
      task.name === 'ThreadControllerImpl::RunTask' &&
      pages.has(thread(task)) &&
      !asked.some((one) => thread(one) === thread(task) && one.ts >= task.ts && one.ts <= task.ts + task.dur),
  );
  expect(tasks.length).toBeGreaterThan(100);
  return Math.max(...tasks.map(({ tdur }) => (tdur ?? 0) / 1000));
}

const player = (page: Page) => page.getByRole('group', { name: 'Player' });
const shownTime = async (page: Page) =>
  Number((await player(page).locator('output').innerText()).split(' ')[0]);

/** Opens an example of the gallery with the developer's flag, and runs it to the mesh. */
async function openExample(page: Page, title: RegExp, edge: string): Promise<void> {
  await page.goto('./?developer');
  await idle(page);
  await page.getByRole('button', { name: title }).first().click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByLabel('Edge length', { exact: true }).fill(edge);
  await page.getByTestId('run').click();
  await meshed(page);
}

async function setDiffusion(page: Page, fields: Record<string, string>): Promise<void> {
  await page.getByLabel('Heat diffusion').check();
  for (const [name, value] of Object.entries(fields)) await page.getByLabel(`Diffusion: ${name}`).fill(value);
}

test('without the flag nothing of simulations is to be seen', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  await page.getByRole('button', { name: /Torus/ }).first().click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.getByLabel('Heat diffusion')).toHaveCount(0);
  await expect(player(page)).toHaveCount(0);
});

test('a diffusion is played as it is computed, and cancelled without losing the mesh', async ({
  page,
  browser,
}) => {
  await watch(page);
  await openExample(page, /Heart with a scar/, '2');
  const tets = await tetCount(page);
  await setDiffusion(page, { Until: '2000', Step: '1', 'Frame every': '2' });
  await idle(page);
  // Until the case is saved.
  await page.waitForTimeout(1500);
  await forget(page);

  await browser.startTracing(page, { categories: ['toplevel'] });
  await page.getByTestId('simulate').click();
  await expect(player(page)).toHaveAttribute('data-state', 'running');
  await expect(page.locator('.legend')).toContainText('Temperature');
  await expect.poll(() => shownTime(page)).toBeGreaterThan(10);
  const view = page.locator('.view-body');
  const [time, picture] = [await shownTime(page), await view.screenshot()];
  await expect.poll(() => shownTime(page)).toBeGreaterThan(time + 20);
  expect((await view.screenshot()).equals(picture)).toBe(false);
  await expect(page.getByRole('button', { name: 'Pause', exact: true })).toBeVisible();

  // Held, nothing is computed; then it goes on.
  await player(page).getByRole('button', { name: 'Hold' }).click();
  await page.waitForTimeout(300);
  const held = await player(page).getAttribute('data-frames');
  await page.waitForTimeout(300);
  expect(await player(page).getAttribute('data-frames')).toBe(held);
  await player(page).getByRole('button', { name: 'Go on' }).click();
  await expect.poll(() => player(page).getAttribute('data-frames')).not.toBe(held);

  const workers = page.workers();
  const cancelled = await page.evaluate(
    () =>
      new Promise<number>((done) => {
        const bar = document.querySelector('.player')!;
        const begin = performance.now();
        new MutationObserver(() => {
          if (bar.getAttribute('data-state') === 'cancelled') done(performance.now() - begin);
        }).observe(bar, { attributes: true });
        document.querySelector<HTMLElement>('[data-testid=cancel]')!.click();
      }),
  );
  await idle(page);
  const longest = longestTask(await browser.stopTracing());
  const { longTasks, stages } = await watched(page);
  console.log(
    `${tets} tetrahedra: cancelled after ${cancelled.toFixed(0)} ms; longest task of the page ${longest.toFixed(0)} ms ` +
      `of the processor, ${Math.max(0, ...longTasks).toFixed(0)} ms by the clock`,
  );
  expect(cancelled).toBeLessThanOrEqual(200);
  expect(longest).toBeLessThanOrEqual(50);
  expect(new Set(stages)).toEqual(new Set(['diffusion']));

  await forget(page);
  await page.getByRole('button', { name: 'Export' }).click();
  const downloading = page.waitForEvent('download');
  await page.getByRole('dialog').getByRole('button', { name: 'Export' }).click();
  expect((await downloading).suggestedFilename()).toMatch(/\.vtu$/);
  await idle(page);
  expect((await watched(page)).stages).toEqual([]);
  expect(page.workers()).toEqual(workers);
});

test('what was computed is played again, by keys and by hand, and has the bytes of the command line', async ({
  page,
}, testInfo) => {
  await watch(page);
  await openExample(page, /Torus/, '4');
  await setDiffusion(page, { Until: '50', Step: '1', 'Frame every': '5' });
  await page.getByTestId('simulate').click();
  await expect(player(page)).toHaveAttribute('data-state', 'done');
  await idle(page);
  await expect(player(page)).toHaveAttribute('data-frames', '11');
  const { recipe } = gallery.find(({ name }) => name === 'torus')!;
  const diffusion = { from: 1, end_ms: 50, step_ms: 1, frame_ms: 5 };
  const path = testInfo.outputPath('case.json');
  writeFileSync(path, JSON.stringify({ ...recipe, sizing: { edge_mm: 4 }, physics: { diffusion } }));
  expect(await framesDigest(page)).toBe(digestUnderNode(path));

  const slider = page.getByRole('slider', { name: 'Time' });
  await slider.focus();
  await page.keyboard.press('Home');
  expect(await shownTime(page)).toBe(0);
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  expect(await shownTime(page)).toBe(10);
  await page.keyboard.press(',');
  expect(await shownTime(page)).toBe(5);
  await expect(slider).toHaveAttribute('aria-valuetext', '5 ms');
  await page.keyboard.press('k');
  await expect(page.getByRole('button', { name: 'Pause', exact: true })).toBeVisible();
  await expect(page.getByRole('button', { name: 'Play', exact: true })).toBeVisible();
  expect(await shownTime(page)).toBe(50);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')).toEqual([]);
  // Another mesh has no frames.
  await page.getByLabel('Edge length', { exact: true }).fill('5');
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(player(page)).toHaveCount(0);
});
