/** Pictures of the app for the docs: the sample heart after a run, light and dark. */
import { mkdir } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { sampleCase } from '../serve.mjs';
import { openAndRun, test } from './support';

const folder = join(dirname(fileURLToPath(import.meta.url)), '../docs');

for (const colorScheme of ['light', 'dark'] as const) {
  test(`app-${colorScheme}.png`, async ({ page }) => {
    await mkdir(folder, { recursive: true });
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    await openAndRun(page, sampleCase);
    await page.getByRole('button', { name: 'Cut', exact: true }).click();
    await page.getByLabel('Place of the cut').fill('0.52');
    await page.waitForTimeout(1500);
    await page.screenshot({ path: join(folder, `app-${colorScheme}.png`) });
  });
}
