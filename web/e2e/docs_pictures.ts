/** Pictures of the documentation, from the app as it is: each a part of the page that its text is about. */
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Locator, Page } from '@playwright/test';
import { sampleCase } from '../serve.mjs';
import { expect, idle, meshed, openAndRun, stage, test } from './support';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const folder = join(root, 'docs/public/pictures');

test.use({ deviceScaleFactor: 1.5 });

/** As WebP, which of a mesh takes a fifth of what PNG does. */
async function shot(what: Page | Locator, name: string): Promise<void> {
  const page = 'page' in what ? what.page() : what;
  await page.waitForTimeout(1500);
  const png = (await what.screenshot()).toString('base64');
  const webp = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    canvas.getContext('2d')!.drawImage(image, 0, 0);
    const blob = await canvas.convertToBlob({ type: 'image/webp', quality: 0.8 });
    let text = '';
    for (const byte of new Uint8Array(await blob.arrayBuffer())) text += String.fromCharCode(byte);
    return btoa(text);
  }, png);
  writeFileSync(join(folder, `${name}.webp`), Buffer.from(webp, 'base64'));
}

test.beforeEach(async ({ page }) => {
  mkdirSync(folder, { recursive: true });
  await page.setViewportSize({ width: 1180, height: 640 });
  await page.emulateMedia({ colorScheme: 'light', reducedMotion: 'reduce' });
});

test('stages', async ({ page }) => {
  const view = page.locator('main');
  await openAndRun(page, sampleCase);
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await page.getByLabel('Place of the cut').fill('0.52');
  await shot(page, 'app');
  await page.getByLabel('Colour by').selectOption('min_dihedral_deg');
  await shot(view, 'optimise');
  await page.getByLabel('Colour by').selectOption('label');
  await page.getByRole('button', { name: 'Flat', exact: true }).click();
  await shot(view, 'tetrahedra');
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  for (const name of ['surface', 'smooth', 'remesh']) {
    await stage(page, name).click();
    await shot(view, name);
  }
  await page.setViewportSize({ width: 1440, height: 860 });
  await stage(page, 'volume').click();
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  // Whoever has zoomed is told no more how it is done.
  for (const key of ['+', '0']) await page.locator('.pane.axial .pane-surface').press(key);
  await page.locator('.pane.axial .pane-surface').blur();
  await shot(view, 'volume');
  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await stage(page, 'sizing').click();
  await shot(view, 'sizing');
  await page.getByRole('button', { name: '3-D', exact: true }).click();
  await stage(page, 'quality').click();
  await page.setViewportSize({ width: 1180, height: 1000 });
  await shot(page.locator('.panel.right'), 'quality');
});

test('links', async ({ page }) => {
  await openAndRun(page, sampleCase);
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByTestId('share-link')).toHaveValue(/#/);
  await shot(page.getByRole('dialog'), 'share');
  const shared = await page.getByTestId('share-link').inputValue();
  await page.goto('about:blank');
  await page.goto(shared);
  await page.getByRole('button', { name: 'Open and run' }).click();
  await meshed(page);
  await shot(page.getByTestId('verdict'), 'verdict');
});

test('heart', async ({ page }) => {
  const view = page.locator('main');
  const recipe = JSON.parse(readFileSync(join(root, 'examples/heart-wave/case.json'), 'utf8'));
  await openAndRun(page, recipe);
  const fibres = page.getByLabel('Fibres', { exact: true });
  await fibres.selectOption('lines');
  await idle(page);
  await shot(view, 'fibres');
  await fibres.selectOption('none');
  await page.getByTestId('activation-map').click();
  await expect(page.locator('.legend')).toContainText('Activation time, eikonal');
  await idle(page);
  await shot(view, 'activation');
  await page.getByTestId('simulate-wave').click();
  await expect(page.locator('.player')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByLabel('Time', { exact: true }).fill('120');
  await shot(page, 'wave');
});
