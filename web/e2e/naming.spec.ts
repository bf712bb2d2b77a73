/** Labels get names: by a numbering, by hand, and from a table; and what the app says about itself. */
import { readFileSync } from 'node:fs';
import { labelledFile, textFile } from './files';
import { dropFile, expect, idle, stage, test } from './support';

const shots = process.env.VOXTET_SHOTS;

test('labels without names are named by a numbering, by hand and from a table', async ({ page }) => {
  // Two shells around pools, as a short axis has them: 1 and 3 are blood.
  const file = labelledFile('heart.nrrd', [30, 24, 24], [2, 2, 2], (i, j, k) => {
    const left = Math.hypot(i - 10, j - 11.5, k - 11.5);
    const right = Math.hypot(i - 19, j - 11.5, k - 11.5);
    return left < 4 ? 3 : left < 7 ? 2 : right < 6 ? 1 : 0;
  });
  await page.goto('./');
  await dropFile(page, file);
  const naming = page.getByTestId('naming');
  await expect(naming).toBeVisible();
  if (shots) await page.screenshot({ path: `${shots}/naming.png` });
  await naming.getByRole('button', { name: /Short axis/ }).click();
  await expect(naming).toHaveCount(0);
  await expect(page.getByLabel('Name of label 2')).toHaveValue('LV_wall');
  await expect(page.getByLabel('Mesh LV_wall')).toBeChecked();
  await expect(page.getByLabel('Mesh LV_blood')).not.toBeChecked();
  await page.getByLabel('Name of label 2').fill('myocardium');
  await page.getByLabel('Name of label 2').press('Tab');
  await expect(page.getByLabel('Mesh myocardium')).toBeChecked();
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(page.getByLabel('Name of label 2')).toHaveValue('LV_wall');

  await dropFile(
    page,
    textFile('names.ctbl', '# names\n0 Background 0 0 0 0\n2 wall 10 200 30 255\n9 other 1 1 1 255\n'),
  );
  await expect(page.getByLabel('Name of label 2')).toHaveValue('wall');
  await expect(page.getByLabel('Colour of wall')).toHaveValue('#0ac81e');
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  if (shots) await page.screenshot({ path: `${shots}/named.png` });

  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done', { timeout: 120_000 });
  await idle(page);
  await page.getByRole('button', { name: 'Export' }).click();
  await page.getByText('Gmsh MSH 2.2').click();
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('dialog').getByRole('button', { name: 'Export' }).click(),
  ]);
  expect(readFileSync(await download.path(), 'utf8')).toContain('"wall"');
});

test('the app tells its version, its licence with the source, and how to cite it', async ({
  page,
  request,
}) => {
  await page.goto('./');
  await page.getByRole('button', { name: 'About voxtet' }).click();
  const about = page.getByRole('dialog', { name: 'About voxtet' });
  await expect(about.locator('code')).toHaveText(/^\d+\.\d+\.\d+\+[0-9a-f]{12}$/);
  await expect(about).toContainText('@software{voxtet');
  await expect(about).toContainText('nothing is uploaded');
  if (shots) await page.screenshot({ path: `${shots}/about.png` });
  for (const [name, start] of [
    ['GNU Affero', 'GNU AFFERO GENERAL PUBLIC LICENSE'],
    ['Source of this page', '\x1f\x8b'],
  ] as const) {
    const address = await about.getByRole('link', { name }).getAttribute('href');
    const body = (await (await request.get(address ?? '')).body()).subarray(0, 200).toString('latin1');
    expect(body).toContain(start);
  }
});
