/** A mesh that was made elsewhere: shown, measured, simulated on, exported. */
import { carpBar, textFile } from './files';
import { dropFile, expect, idle, meshed, stage, tetCount, test } from './support';

test("openCARP's mesh with fibres is shown and measured, and a wave runs on it", async ({ page }) => {
  await page.goto('./');
  await dropFile(page, ...carpBar('bar'));
  await meshed(page);
  expect(await tetCount(page)).toBe(1152);
  await expect(page.locator('.chip')).toHaveCount(3);
  await expect(stage(page, 'remesh')).toHaveCount(0);
  const facts = page.locator('.read-facts');
  await expect(facts).toContainText('Tetrahedra1,152');
  await expect(facts).toContainText('Fibresread');
  await expect(page.getByRole('heading', { name: 'Element size' })).toHaveCount(0);
  await expect(page.getByRole('heading', { name: 'Fidelity to the labels' })).toHaveCount(0);

  await page.getByLabel('Fibres').selectOption('glyphs');
  await idle(page);
  await page.getByRole('button', { name: 'Simulate', exact: true }).click();
  await expect(page.getByRole('heading', { name: 'Physics' })).toBeVisible();

  await page.getByTestId('activation-map').click();
  await expect(page.getByRole('combobox', { name: 'Colour by' })).toHaveValue('eikonal_ms');
  await idle(page);
  if (process.env.VOXTET_SHOTS)
    await page.screenshot({ path: `${process.env.VOXTET_SHOTS}/opened_mesh.png` });

  // Values of the same mesh, as its owner has them.
  const points = 13 * 5 * 5;
  await dropFile(page, textFile('bar.lat.dat', '3.5\n'.repeat(points)));
  await expect(page.getByRole('combobox', { name: 'Colour by' })).toHaveValue('lat');
  await idle(page);
});
