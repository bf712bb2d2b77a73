/** The documentation: opened from the app, read, searched, under whatever address. */
import AxeBuilder from '@axe-core/playwright';
import { mkdtempSync, symlinkSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { serve } from '../serve.mjs';
import { expect, idle, test } from './support';

const dist = join(dirname(fileURLToPath(import.meta.url)), '../dist');

test('opens from the start and from the dialog about the app', async ({ page, context }) => {
  await page.goto('./');
  await idle(page);
  const opened = context.waitForEvent('page');
  await page.getByRole('link', { name: 'Documentation' }).click();
  await expect((await opened).getByRole('heading', { level: 1 })).toContainText('voxtet');
  await page.getByRole('button', { name: 'About voxtet' }).click();
  await expect(page.getByRole('dialog').getByRole('link', { name: 'Documentation' })).toHaveAttribute(
    'href',
    'docs/',
  );
});

for (const colorScheme of ['light', 'dark'] as const)
  test(`pages have no accessibility finding (${colorScheme})`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    for (const path of ['start', 'stages/sizing', 'reference/recipe']) {
      await page.goto(`./docs/${path}.html`);
      await expect(page.locator('html')).toHaveClass(colorScheme === 'dark' ? /dark/ : /^(?!.*dark)/);
      await expect(page.getByRole('navigation', { name: 'Pager' })).toBeVisible();
      const { violations } = await new AxeBuilder({ page }).analyze();
      expect(violations.map(({ id, nodes }) => `${path}: ${id}: ${nodes[0].target}`)).toEqual([]);
    }
  });

test.describe('below a folder of a host', () => {
  let server: Server;
  let docs: string;
  test.beforeAll(async () => {
    const site = mkdtempSync(join(tmpdir(), 'voxtet-site-'));
    symlinkSync(dist, join(site, 'sub'));
    server = await serve({ root: site, port: 0 });
    docs = `http://127.0.0.1:${(server.address() as AddressInfo).port}/sub/docs/`;
  });
  test.afterAll(() => {
    server.close();
  });
  test.use({ otherHost: 'http://127.0.0.1:' });

  test('leads from page to page, finds what is searched, and back to the app', async ({ page }) => {
    await page.goto(docs);
    await page.getByRole('link', { name: 'Smooth', exact: true }).click();
    await expect(page.getByRole('heading', { level: 1 })).toContainText('Smooth');
    await expect(page).toHaveURL(`${docs}stages/smooth.html`);
    // Links that stayed while the page changed, and a picture of the new one.
    await page.getByRole('link', { name: 'Fields of a case' }).click();
    await expect(page).toHaveURL(`${docs}reference/recipe.html`);
    await page.getByRole('link', { name: 'Better shapes', exact: true }).click();
    const picture = page.getByRole('img', { name: /coloured by the smallest dihedral angle/ });
    await expect
      .poll(() => picture.evaluate((image: HTMLImageElement) => image.naturalWidth))
      .toBeGreaterThan(0);

    await page.getByRole('button', { name: 'Search' }).click();
    await page.getByRole('searchbox').fill('precedence');
    await page.locator('.result', { hasText: /Fields of a case\s*source/ }).click();
    await expect(page).toHaveURL(/\/sub\/docs\/reference\/recipe\.html#source$/);
    await expect(page.locator('[id="source.precedence"]')).toBeVisible();

    await page.getByRole('link', { name: 'Open the app' }).click();
    await expect(page).toHaveURL(new RegExp(`^${docs.replace('docs/', '')}(?!docs)`));
    await idle(page);
  });
});
