/** Pictures for the docs, the gallery and the examples, from the app as it is. */
import { mkdir, readdir, readFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { sampleCase } from '../serve.mjs';
import { gallery } from '../src/store/case/gallery';
import { meshed, openAndRun, test } from './support';

const here = dirname(fileURLToPath(import.meta.url));
const docs = join(here, '../docs');
const examples = join(here, '../../examples');
const icons = join(here, '../public');
const pictures = join(icons, 'gallery');

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

/** The view on nothing, without what lies around it. */
const viewAlone = {
  content: `html, body, .app, .view, .view-body { background: none !important }
    .view-host, .view-host * { --cards: 0 !important }
    .triad, .scale-bar, .view-buttons, .tool-options, .label-key, .legend { display: none !important }
    .pipeline, .panel { visibility: hidden }`,
};

test.describe('view alone', () => {
  test.use({ bypassCSP: true, deviceScaleFactor: 1 });

  /** The gallery's pictures suit either theme. */
  for (const { name, recipe } of gallery) {
    test(`${name}.png`, async ({ page }) => {
      await mkdir(pictures, { recursive: true });
      await page.setViewportSize({ width: 976, height: 482 });
      await openAndRun(page, recipe);
      await page.addStyleTag(viewAlone);
      await page.keyboard.press('f');
      await page.waitForTimeout(1500);
      await page
        .locator('.view-host')
        .screenshot({ path: join(pictures, `${name}.png`), omitBackground: true });
    });
  }

  /** One flat cut for each number of layers, seen along the heart's axis. */
  test('wall-layers', async ({ page }) => {
    const folder = join(examples, 'wall-layers');
    const recipe = JSON.parse(await readFile(join(folder, 'case.json'), 'utf8'));
    await page.setViewportSize({ width: 1900, height: 1280 });
    const cuts: string[] = [];
    for (const layers of [1, 2, 3, 4]) {
      recipe.sizing.thickness[0].layers = layers;
      await openCut(page, recipe, 'light');
      await page.getByRole('button', { name: 'Flat', exact: true }).click();
      await page.getByRole('button', { name: 'Cut from head to feet' }).click();
      await page.getByRole('button', { name: "View from the patient's head" }).click();
      await page.addStyleTag(viewAlone);
      await page.waitForTimeout(1500);
      const cut = await page.locator('.view-host').screenshot({ omitBackground: true });
      cuts.push(`<img src="data:image/png;base64,${cut.toString('base64')}">`);
      await page.goto('about:blank');
    }
    await page.setContent(
      `<style>body { margin: 0; background: #fff } img { width: 100% }
        div { display: grid; grid-template-columns: 1fr 1fr; width: 1400px }</style><div>${cuts.join('')}</div>`,
    );
    await page.locator('div').screenshot({ path: join(folder, 'picture.png') });
  });
});

/** Icons of the installed app. Systems cut one that is `maskable` to a shape of theirs: its ground fills the square. */
test('icons', async ({ page }) => {
  const svg = await readFile(join(icons, 'icon.svg'), 'utf8');
  const full = svg
    .replace('rx="7" ', '')
    .replace(/(<path.*>)(?=<\/svg>)/, '<g transform="translate(4 5) scale(.75)">$1</g>');
  for (const [name, size, text] of [
    ['icon-192', 192, svg],
    ['icon-512', 512, svg],
    ['icon-maskable-512', 512, full],
  ] as const) {
    await page.setViewportSize({ width: size, height: size });
    await page.setContent(`<style>body { margin: 0 } svg { display: block }</style>${text}`);
    await page.screenshot({ path: join(icons, `${name}.png`), omitBackground: true });
  }
});

test('examples', async ({ page }) => {
  for (const entry of await readdir(examples, { withFileTypes: true })) {
    if (!entry.isDirectory()) continue;
    const folder = join(examples, entry.name);
    // Others have pictures of their own.
    if (!(await readFile(join(folder, 'README.md'), 'utf8')).includes('![Cut through the mesh](picture.png)'))
      continue;
    await openCut(page, JSON.parse(await readFile(join(folder, 'case.json'), 'utf8')), 'light');
    await page.locator('main').screenshot({ path: join(folder, 'picture.png') });
    await page.goto('about:blank');
  }
});
