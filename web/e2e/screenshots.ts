/** Pictures for the docs, the gallery and the examples, from the app as it is. */
import { mkdir, readdir, readFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { sampleCase } from '../serve.mjs';
import { gallery } from '../src/store/gallery';
import { meshed, openAndRun, test } from './support';

const here = dirname(fileURLToPath(import.meta.url));
const docs = join(here, '../docs');
const examples = join(here, '../../examples');
const pictures = join(here, '../public/gallery');

async function openCut(page: Page, recipe: object, colorScheme: 'light' | 'dark'): Promise<void> {
  await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
  await openAndRun(page, recipe);
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await page.getByLabel('Place of the cut').fill('0.52');
  await page.waitForTimeout(1500);
}

for (const colorScheme of ['light', 'dark'] as const) {
  test(`app-${colorScheme}.png`, async ({ page }) => {
    await mkdir(docs, { recursive: true });
    await openCut(page, sampleCase, colorScheme);
    await page.screenshot({ path: join(docs, `app-${colorScheme}.png`) });
  });
}

test('slices.png', async ({ page }) => {
  await openCut(page, sampleCase, 'light');
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await page.getByLabel('Colour by').selectOption('target_mm');
  await page.waitForTimeout(1500);
  await page.screenshot({ path: join(docs, 'slices.png') });
});

test('compare.png', async ({ page }) => {
  await openCut(page, sampleCase, 'dark');
  await page.getByRole('button', { name: 'Pin this run' }).click();
  await page.getByLabel('Edge length', { exact: true }).fill('6');
  await page.getByTestId('run').click();
  await meshed(page);
  await page.getByRole('button', { name: 'Side by side' }).click();
  await page.waitForTimeout(1500);
  await page.screenshot({ path: join(docs, 'compare.png') });
});

/** The gallery's pictures stand on nothing, so that they suit either theme. */
test.describe('gallery', () => {
  test.use({ bypassCSP: true, deviceScaleFactor: 1 });
  for (const { name, recipe } of gallery) {
    test(`${name}.png`, async ({ page }) => {
      await mkdir(pictures, { recursive: true });
      await page.setViewportSize({ width: 976, height: 482 });
      await openAndRun(page, recipe);
      await page.addStyleTag({
        content: `html, body, .app, .view, .view-body { background: none !important }
          .triad, .scale-bar { display: none !important }
          .pipeline, .panel { visibility: hidden }`,
      });
      await page.waitForTimeout(1000);
      await page.locator('.view-host').screenshot({ path: join(pictures, `${name}.png`), omitBackground: true });
    });
  }
});

test('examples', async ({ page }) => {
  for (const entry of await readdir(examples, { withFileTypes: true })) {
    if (!entry.isDirectory()) continue;
    const folder = join(examples, entry.name);
    // Others have pictures of their own.
    if (!(await readFile(join(folder, 'README.md'), 'utf8')).includes('![Cut through the mesh](picture.png)')) continue;
    await openCut(page, JSON.parse(await readFile(join(folder, 'case.json'), 'utf8')), 'light');
    await page.locator('main').screenshot({ path: join(folder, 'picture.png') });
    await page.goto('about:blank');
  }
});
