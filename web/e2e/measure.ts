/** Figures of the app on this machine, printed; nothing is judged. `npm run measure`, or one with -g. */
import { loadavg } from 'node:os';
import type { Page } from '@playwright/test';
import { stageNames } from '../src/engine/contract';
import { idle, link, meshed, smallHeart, test } from './support';

const repeats = 20;
const moves = 50;
const jobs = Number(process.env.JOBS ?? 200);

const quantile = (values: readonly number[], q: number) =>
  [...values].sort((a, b) => a - b)[Math.round(q * (values.length - 1))];
const spread = (values: readonly number[]) =>
  `median ${quantile(values, 0.5).toFixed(0)}, from ${Math.min(...values).toFixed(0)} to ${Math.max(...values).toFixed(0)}`;

/** With the machine's load, since others may be at work on it. */
function say(figure: string): void {
  console.log(`${figure} (load ${loadavg()[0].toFixed(1)})`);
}

async function open(page: Page, recipe: object): Promise<void> {
  await page.goto(link(recipe));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
}

test('cancel to an engine that answers, at every stage', async ({ page }) => {
  await open(page, {
    source: { phantom: { kind: 'biventricle', spacing_mm: [2, 2, 2] } },
    labels: [1, 2],
    sizing: { edge_mm: 2.5 },
  });
  for (const name of stageNames) {
    const found: number[] = [];
    let missed = 0;
    while (found.length < repeats && missed < 3 * repeats) {
      const milliseconds = await page.evaluate(cancelledAt, name);
      if (milliseconds === null) missed++;
      else found.push(milliseconds);
    }
    say(
      `cancel in ${name}: ${found.length === 0 ? 'never met it' : `${spread(found)} ms`} (${found.length} times)`,
    );
  }
});

/** Runs, cancels as soon as a stage is at work; null where the run was over before. */
function cancelledAt(name: string): Promise<number | null> {
  const app = document.querySelector('.app')!;
  const chip = document.querySelector(`.chip[data-stage=${name}]`)!;
  const before = app.getAttribute('data-cancel-ms');
  const button = (id: string) => document.querySelector<HTMLButtonElement>(`[data-testid=${id}]`);
  return new Promise((done) => {
    let cancelled = false;
    const watch = new MutationObserver(look);
    const end = (value: number | null) => {
      watch.disconnect();
      setTimeout(() => done(value), 300);
    };
    function look() {
      const after = app.getAttribute('data-cancel-ms');
      if (cancelled && after !== before) end(Number(after));
      if (cancelled || !button('cancel')) return;
      if (chip.getAttribute('data-state') === 'running') {
        cancelled = true;
        button('cancel')?.click();
        // The same milliseconds as the last time are no change.
        setTimeout(() => end(Number(app.getAttribute('data-cancel-ms'))), 3000);
      } else if (chip.getAttribute('data-state') === 'done') {
        cancelled = true;
        button('cancel')?.click();
        end(null);
      }
    }
    watch.observe(document.body, { subtree: true, attributes: true, childList: true });
    button('run')?.click();
  });
}

test('first surface of a volume of 256 voxels a side after the drop', async ({ browser, baseURL }) => {
  const found: number[] = [];
  for (let i = 0; i < 5; i++) {
    // A profile of its own: nothing to be taken up.
    const context = await browser.newContext({ baseURL });
    const page = await context.newPage();
    await page.goto('./');
    await idle(page);
    found.push(await page.evaluate(surfaceAfterDrop));
    await context.close();
  }
  say(`first surface of 256³: ${spread(found)} ms`);
});

/** Drops two balls of voxels, one in the other; milliseconds until their surface has been drawn. */
function surfaceAfterDrop(): Promise<number> {
  const side = 256;
  const voxels = new Uint8Array(side ** 3);
  for (let k = 0, at = 0; k < side; k++)
    for (let j = 0; j < side; j++)
      for (let i = 0; i < side; i++, at++) {
        const r = Math.hypot(i - 127.5, j - 127.5, k - 127.5);
        voxels[at] = r > 100 ? 0 : r > 70 ? 1 : 2;
      }
  const header =
    'NRRD0004\ntype: uint8\ndimension: 3\nspace: RAS\nsizes: 256 256 256\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n';
  const transfer = new DataTransfer();
  transfer.items.add(new File([header, voxels], 'balls.nrrd'));
  return new Promise((done) => {
    const begin = performance.now();
    const chip = document.querySelector('.chip[data-stage=surface]')!;
    const watch = new MutationObserver(() => {
      if (chip.getAttribute('data-state') !== 'done') return;
      watch.disconnect();
      requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now() - begin)));
    });
    watch.observe(document.body, { subtree: true, attributes: true, childList: true });
    document
      .querySelector('main')!
      .dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true }));
  });
}

test('tasks of the main thread while a fine mesh is being made', async ({ page }) => {
  await open(page, {
    source: { phantom: { kind: 'biventricle', spacing_mm: [2, 2, 2] } },
    labels: [1, 2],
    sizing: { edge_mm: 1.3 },
  });
  await page.evaluate(() => {
    const tasks: [number, string][] = [];
    Object.assign(window, { tasks });
    new PerformanceObserver((list) => {
      for (const { duration } of list.getEntries())
        tasks.push([
          Math.round(duration),
          [...document.querySelectorAll('.chip[data-state=done]')].at(-1)?.getAttribute('data-stage') ?? '',
        ]);
    }).observe({ entryTypes: ['longtask'] });
  });
  await page.getByTestId('run').click();
  await meshed(page);
  await page.waitForTimeout(2000);
  const tasks = await page.evaluate(() => (window as unknown as { tasks: [number, string][] }).tasks);
  const tets = await page.getByTestId('tets').innerText();
  say(
    `${tets} tetrahedra; tasks over 50 ms (after which stage): ${tasks.map((task) => task.join(' ')).join(', ') || 'none'}`,
  );
});

test('moving a cut through a fine mesh', async ({ page }) => {
  await open(page, {
    source: { phantom: { kind: 'biventricle', spacing_mm: [2, 2, 2] } },
    labels: [1, 2],
    sizing: { edge_mm: 1.27 },
  });
  await page.getByTestId('run').click();
  await meshed(page);
  const tets = await page.getByTestId('tets').innerText();
  const devtools = await page.context().newCDPSession(page);
  await devtools.send('Performance.enable');
  // What the page itself does; the drawing is another process's, in software here.
  const spent = async () => {
    const { metrics } = await devtools.send('Performance.getMetrics');
    const seconds = (name: string) => metrics.find((metric) => metric.name === name)!.value;
    return 1000 * (seconds('ScriptDuration') + seconds('LayoutDuration') + seconds('RecalcStyleDuration'));
  };
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  for (const kind of ['Whole', 'Flat']) {
    await page.getByRole('button', { name: kind, exact: true }).click();
    await page.evaluate(movedCut, 3);
    const before = await spent();
    await page.evaluate(movedCut, moves);
    say(
      `${tets} tetrahedra, ${kind.toLowerCase()} cut: ${((await spent()) - before).toFixed(0)} ms of the main thread in ${moves} moves`,
    );
  }
});

/** Moves the cut so many times, drawing each. */
async function movedCut(times: number): Promise<void> {
  const place = document.querySelector<HTMLInputElement>('input[aria-label="Place of the cut"]')!;
  for (let i = 1; i <= times; i++) {
    place.value = String((i % 10) / 10);
    place.dispatchEvent(new Event('input', { bubbles: true }));
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
  }
}

test('memory of the page over many jobs', async ({ page }) => {
  await open(page, smallHeart);
  const devtools = await page.context().newCDPSession(page);
  const own: number[] = [],
    whole: number[] = [];
  for (let job = 1; job <= jobs; job++) {
    await page.getByLabel('Edge length', { exact: true }).fill(job % 2 === 1 ? '5.2' : '5');
    await page.getByTestId('run').click();
    await meshed(page);
    if (job % 20 !== 0) continue;
    await devtools.send('HeapProfiler.collectGarbage');
    const { usedSize, backingStorageSize = 0 } = (await devtools.send('Runtime.getHeapUsage')) as {
      usedSize: number;
      backingStorageSize?: number;
    };
    const all = await page.evaluate(async () => {
      const { measureUserAgentSpecificMemory: measure } = performance as unknown as {
        measureUserAgentSpecificMemory?: () => Promise<{ bytes: number }>;
      };
      return measure ? (await measure.call(performance)).bytes : 0;
    });
    const mb = (bytes: number) => (bytes / 1e6).toFixed(1);
    own.push(usedSize + backingStorageSize);
    whole.push(all);
    say(
      `after ${job} jobs: page ${mb(usedSize)} + ${mb(backingStorageSize)} MB, with its workers ${mb(all)} MB`,
    );
  }
  for (const [what, bytes] of [
    ['the page without its workers', own],
    ['with them', whole],
  ] as const) {
    const change = bytes.map((some) => 100 * (some / bytes[0] - 1));
    say(
      `from the 20th job on, ${what}: ${Math.min(...change).toFixed(1)} to ${Math.max(...change).toFixed(1)} %`,
    );
  }
});
