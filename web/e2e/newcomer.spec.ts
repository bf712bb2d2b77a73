/** What the app says and proposes to somebody who opens a first file. */
import { labelledFile } from './files';
import { dropFile, expect, idle, meshed, openAndRun, realVolume, smallHeart, stage, test } from './support';

const shots = process.env.VOXTET_SHOTS;

/** A ball that is brighter than what surrounds it, with noise, as an image has it. */
const imageFile = () =>
  labelledFile('mri.nrrd', [40, 40, 40], [2, 2, 2], (i, j, k) => {
    const noise = (i * 7919 + j * 104729 + k * 1299709) % 61;
    return Math.hypot(i - 19.5, j - 19.5, k - 19.5) < 12 ? 150 + noise : 20 + noise;
  });

test('an image is asked about before any surface, and a range of its values is meshed', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  await dropFile(page, imageFile());
  const dialog = page.getByRole('dialog');
  await expect(dialog).toContainText(/holds 1\d\d values/);
  await expect(stage(page, 'surface')).toHaveAttribute('data-state', 'waiting');
  // Its values are 20 to 80 and 150 to 210.
  await expect.poll(() => dialog.getByLabel('Smallest value').inputValue().then(Number)).toBeGreaterThan(80);
  expect(Number(await dialog.getByLabel('Smallest value').inputValue())).toBeLessThanOrEqual(150);
  await expect(dialog.locator('.chart canvas')).toBeVisible();
  if (shots) await page.screenshot({ path: `${shots}/image.png` });
  await dialog.getByLabel('Smallest value').fill('300');
  await dialog.getByLabel('Largest value').fill('400');
  await dialog.getByRole('button', { name: 'Take them as label 1' }).click();
  await expect(page.getByRole('alert')).toContainText('the values go from 20 to 210');
  await dialog.getByLabel('Smallest value').fill('120');
  await dialog.getByRole('button', { name: 'Take them as label 1' }).click();
  await expect(dialog).toHaveCount(0);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.getByLabel('Name of label 1')).toHaveCount(1);
  await page.getByTestId('run').click();
  await meshed(page);
  // How it was read belongs to the case.
  await page.getByRole('button', { name: 'How it is read…' }).click();
  await expect(page.getByLabel('Smallest value of label 1')).toHaveValue('120');
});

test('who knows that an image holds labels goes on', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  await dropFile(page, imageFile());
  await page.getByRole('button', { name: 'They are labels: go on' }).click();
  await expect(stage(page, 'volume')).toHaveAttribute('data-state', 'done');
  await page.getByRole('button', { name: 'Stop' }).click();
});

test('a background that is a label, and what is inside of a wall, are proposed', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  // 1 all around, 4 a wall, 2 what is inside of it.
  const file = labelledFile('boxed.nrrd', [30, 30, 30], [2, 2, 2], (i, j, k) => {
    const r = Math.hypot(i - 14.5, j - 14.5, k - 14.5);
    return r < 6 ? 2 : r < 10 ? 4 : 1;
  });
  await dropFile(page, file);
  const background = page.getByTestId('background');
  await expect(background).toContainText('label 1 surrounds everything else');
  if (shots) await page.screenshot({ path: `${shots}/background.png` });
  await background.getByRole('button').click();
  await expect(background).toHaveCount(0);
  await expect(page.getByLabel('Mesh label 1')).not.toBeChecked();
  await page.getByRole('button', { name: 'Wall', exact: true }).click();
  const wall = page.getByRole('group', { name: 'Wall', exact: true });
  const inside = page.getByRole('group', { name: 'Inside of it' });
  await expect(wall.getByRole('button', { name: 'label 4' })).toHaveAttribute('aria-pressed', 'true');
  await expect(inside.getByRole('button', { name: 'label 2' })).toHaveAttribute('aria-pressed', 'true');
  await expect(inside.getByRole('button', { name: 'label 1' })).toHaveAttribute('aria-pressed', 'false');
});

test('sizes far beyond the budget are amber, with sizes that keep it', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  const file = labelledFile('ball.nrrd', [40, 40, 40], [4, 4, 4], (i, j, k) =>
    Number(Math.hypot(i - 19.5, j - 19.5, k - 19.5) < 18),
  );
  await dropFile(page, file);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.getByTestId('use-budget')).toHaveCount(0);
  await page.getByLabel('Edge length', { exact: true }).fill('1.5');
  const use = page.getByTestId('use-budget');
  await expect(use).toHaveText(/Use about [\d.]+ mm instead/);
  await expect(page.getByTestId('forecast')).toHaveClass(/caution/);
  if (shots) await page.screenshot({ path: `${shots}/budget.png` });
  await use.click();
  await expect(page.getByTestId('forecast')).toContainText(/about (49|50)0,000 tetrahedra/);
  await expect(use).toHaveCount(0);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(page.getByLabel('Edge length', { exact: true })).toHaveValue('1.5');
});

test('a volume of many voxels begins with sizes that keep the budget', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  // 8 million mm³: at twice the spacing it would have ten million tetrahedra.
  const file = labelledFile('large.nrrd', [100, 100, 100], [2, 2, 2], (i, j, k) =>
    Number(Math.min(i, j, k) > 1 && Math.max(i, j, k) < 98),
  );
  await dropFile(page, file);
  await expect(stage(page, 'volume')).toHaveAttribute('data-state', 'done');
  const edge = Number(await page.getByLabel('Edge length', { exact: true }).inputValue());
  expect(edge).toBeGreaterThan(5);
  expect(edge).toBeLessThan(6);
});

test('checks say what was found and wanted, sizes those of the body, measures what they mean', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByText(/\d+ passed/).click();
  const list = page.locator('.checklist').last();
  await expect(list).toContainText(/all [\d,]+ points finite/);
  await expect(list).toContainText(/none of [\d,]+ tetrahedra/);
  await expect(list).toContainText(/[\d.]+°, wanted ≥ 10°/);
  // Beyond the body the field grows on; 3 mm in the scar and 5 mm elsewhere were asked for.
  await expect(stage(page, 'sizing')).toContainText(/3\.0–5\.0 mm/);
  await expect(page.getByText(/% of all edges have 0\.71 to 1\.41 times their target/)).toBeVisible();
  if (shots) await page.screenshot({ path: `${shots}/evidence.png` });
  await page.getByRole('button', { name: 'What they mean…' }).click();
  const dialog = page.getByRole('dialog');
  await expect(dialog.locator('.tet-drawing')).toHaveCount(6);
  const value = dialog.locator('output').first();
  const before = await value.innerText();
  if (shots) await page.screenshot({ path: `${shots}/glossary.png` });
  await dialog.getByLabel('Flatten it').fill('0');
  await expect(value).toHaveText('70.5°');
  expect(before).not.toBe('70.5°');
});

const heart = realVolume('biv_ed_scar_1mm.nii.gz');
test('a real heart is meshed without its pools in two clicks', async ({ page }) => {
  test.skip(!heart, 'the volume is not there: set VOXTET_DATA');
  await page.goto('./');
  await idle(page);
  await dropFile(page, heart!);
  await page
    .getByTestId('naming')
    .getByRole('button', { name: /Two ventricles/ })
    .click();
  await expect(page.getByLabel('Mesh LV_blood')).not.toBeChecked();
  await expect(page.getByLabel('Mesh scar')).toBeChecked();
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.locator('.checklist li.fail')).toHaveCount(0);
});
