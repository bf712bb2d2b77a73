import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { test as base, expect, type Page } from '@playwright/test';

const here = dirname(fileURLToPath(import.meta.url));

/** A heart coarse enough to be meshed in seconds while the view is drawn by software. */
export const smallHeart = {
  source: { phantom: { kind: 'biventricle', scar: true, spacing_mm: [3, 3, 3] } },
  labels: [1, 2, 5, 6],
  sizing: { edge_mm: 5, labels: [{ label: 5, edge_mm: 3 }] },
};

/** The same heart, fine enough that a run can be cancelled in its middle. */
export const fineHeart = {
  source: { phantom: { kind: 'biventricle', spacing_mm: [2, 2, 2] } },
  labels: [1, 2],
  sizing: { edge_mm: 1.2 },
};

export const link = (recipe: object): string => `./#j=${encodeURIComponent(JSON.stringify(recipe))}`;

/** A real volume, or null where the data folder is absent. */
export function realVolume(name: string): string | null {
  const folder = process.env.VOXTET_DATA ?? resolve(here, '../../../shared/data');
  const path = join(folder, name);
  return existsSync(path) ? path : null;
}

/**
 * Every test also promises a clean console and no request off the page's own origin, but to the host that it is about.
 */
export const test = base.extend<{ otherHost: string; complaints: string[] }>({
  otherHost: ['', { option: true }],
  complaints: [
    async ({ page, baseURL, otherHost }, use) => {
      const complaints: string[] = [];
      page.on('console', (message) => {
        const blocked = message.text() === 'Service Worker registration blocked by Playwright';
        if (['error', 'warning'].includes(message.type()) && !blocked)
          complaints.push(`${message.type()}: ${message.text()}`);
      });
      page.on('pageerror', (error) => complaints.push(`uncaught: ${error.message}`));
      page.on('request', (request) => {
        const url = request.url();
        const expected = otherHost !== '' && url.startsWith(otherHost);
        if (!url.startsWith(baseURL ?? '') && !expected && !/^(data|blob):/.test(url))
          complaints.push(`off-origin: ${url}`);
      });
      await use(complaints);
      expect(complaints).toEqual([]);
    },
    { auto: true },
  ],
});

export const idle = (page: Page) => expect(page.locator('.app')).toHaveAttribute('data-activity', 'idle');
export const stage = (page: Page, name: string) => page.locator(`.chip[data-stage=${name}]`);

export async function openAndRun(page: Page, recipe: object): Promise<void> {
  await page.goto(link(recipe));
  await page.getByRole('button', { name: 'Open and run' }).click();
  await meshed(page);
}

export async function meshed(page: Page): Promise<void> {
  await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await expect(page.getByTestId('tets')).toBeVisible();
}

/** Drops files on the page, as from the desktop. */
export async function dropFile(page: Page, ...paths: string[]): Promise<void> {
  const files = await Promise.all(
    paths.map(async (path) => [basename(path), (await readFile(path)).toString('base64')] as const),
  );
  const transfer = await page.evaluateHandle((all) => {
    const data = new DataTransfer();
    for (const [name, content] of all)
      data.items.add(new File([Uint8Array.from(atob(content), (c) => c.charCodeAt(0))], name));
    return data;
  }, files);
  await page.locator('main').dispatchEvent('drop', { dataTransfer: transfer });
}

/** Colours on the screen at places of the page. */
export async function pixels(page: Page, places: { x: number; y: number }[]): Promise<number[][]> {
  const picture = (await page.screenshot()).toString('base64');
  return page.evaluate(
    async ([png, at]) => {
      const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d', {
        willReadFrequently: true,
      })!;
      context.drawImage(image, 0, 0);
      return at.map(({ x, y }) => [...context.getImageData(x, y, 1, 1).data]);
    },
    [picture, places] as const,
  );
}

/** How many pixels of a picture have a colour, or one within so much of each of its parts. */
export async function countColour(page: Page, png: Buffer, rgb: number[], within = 0): Promise<number> {
  return page.evaluate(
    async ([base64, wanted, tolerance]) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        if (wanted.every((part, c) => Math.abs(data[i + c] - part) <= tolerance)) count++;
      return count;
    },
    [png.toString('base64'), rgb, within] as const,
  );
}

export const slice = (page: Page, name: string) => page.locator(`.pane.${name}`);

/** Colours at a lattice of places of a pane, away from its head line, crosshair and letters. */
export async function sampled(page: Page, name: string): Promise<number[][]> {
  await page.waitForTimeout(300);
  const box = (await slice(page, name).boundingBox())!;
  const places = [0.3, 0.4, 0.6, 0.7].flatMap((x) =>
    [0.4, 0.56, 0.64, 0.7].map((y) => ({
      x: Math.round(box.x + x * box.width),
      y: Math.round(box.y + y * box.height),
    })),
  );
  return pixels(page, places);
}

export async function tetCount(page: Page): Promise<number> {
  return Number((await page.getByTestId('tets').innerText()).replaceAll(',', ''));
}

export { expect };
