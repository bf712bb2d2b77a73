/** The page that checks the physics in the reader's browser. */
import AxeBuilder from '@axe-core/playwright';
import { expect, test } from './support';

test('every check agrees, computed in the page', async ({ page }) => {
  test.setTimeout(400_000);
  await page.goto('./verification.html');
  await page.getByRole('button', { name: 'Run the checks' }).click();
  await expect(page.getByText('Checking…')).toBeVisible();
  await expect(page.getByRole('status')).toContainText('agree with what is expected', { timeout: 380_000 });
  await expect(page.getByRole('heading', { name: 'Plane wave' })).toBeVisible();
  expect(await page.getByRole('cell', { name: 'no', exact: true }).count()).toBe(0);
  expect(await page.getByRole('cell', { name: 'yes', exact: true }).count()).toBeGreaterThan(15);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
});
