/** A link that brings its volume along. */
import { labelledFile } from './files';
import { dropFile, expect, idle, meshed, realVolume, stage, test } from './support';

test('a link holds the volume of a file, and gives the same mesh to whoever opens it', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  const file = labelledFile('body.nrrd', [30, 26, 22], [2, 2.5, 3], (i, j, k) => {
    const r = Math.hypot(i - 14.5, 1.2 * (j - 12.5), 1.4 * (k - 10.5));
    return r < 6 ? 2 : r < 10 ? 1 : 0;
  });
  await dropFile(page, file);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await page.getByLabel('Name of label 2').fill('core');
  await page.getByLabel('Name of label 2').press('Tab');
  await page.getByLabel('Edge length', { exact: true }).fill('6');
  await page.getByTestId('run').click();
  await meshed(page);
  await page.getByRole('button', { name: 'Share' }).click();
  const dialog = page.getByRole('dialog');
  await expect(dialog).toContainText('body.nrrd is not in the link');
  const link = dialog.getByTestId('share-link');
  await expect(link).toHaveValue(/#c1=/);
  const short = (await link.inputValue()).length;
  await dialog.getByLabel('With the volume itself').check();
  await expect(dialog).not.toContainText('is not in the link');
  await expect.poll(async () => (await link.inputValue()).length).toBeGreaterThan(short + 100);
  const url = await link.inputValue();

  const receiver = await page.context().newPage();
  await receiver.goto(url);
  const offer = receiver.getByRole('dialog');
  await expect(offer).toContainText('body.nrrd, in the link itself');
  await offer.getByRole('button', { name: 'Open and run' }).click();
  await meshed(receiver);
  await expect(receiver.getByTestId('verdict')).toContainText('Reproduced');
  await expect(receiver.getByLabel('Name of label 2')).toHaveValue('core');
  await receiver.close();
});

const heart = realVolume('biv_ed_scar_1mm.nii.gz');
test('a real heart fits into a link', async ({ page }) => {
  test.skip(!heart, 'the volume is not there: set VOXTET_DATA');
  await page.goto('./');
  await idle(page);
  await dropFile(page, heart!);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByRole('button', { name: 'Share' }).click();
  const dialog = page.getByRole('dialog');
  await dialog.getByLabel('With the volume itself').check();
  const link = dialog.getByTestId('share-link');
  await expect.poll(async () => (await link.inputValue()).length).toBeGreaterThan(4000);
  expect((await link.inputValue()).length).toBeLessThan(11_500);
});
