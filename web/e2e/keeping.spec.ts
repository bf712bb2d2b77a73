/** That nothing a person did is lost, and nothing that is no longer so is said. */
import { maskFile } from './files';
import { dropFile, expect, fineHeart, idle, link, meshed, slice, smallHeart, stage, test } from './support';

const coarse = { source: smallHeart.source, labels: [1, 2], sizing: { edge_mm: 6 } };

test("a link's promise stays with its recipe over a reload", async ({ page }) => {
  await page.goto(link({ ...coarse, expected: { engine: 'another', digest: 'a'.repeat(64), tets: 12 } }));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await page.getByLabel('Edge length', { exact: true }).fill('7');
  await page.waitForTimeout(1500);
  await page.reload();
  await expect(page.getByLabel('Edge length', { exact: true })).toHaveValue('7');
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.locator('.verdict')).toContainText('settings were changed');
  await page.getByLabel('Edge length', { exact: true }).fill('6');
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.getByTestId('verdict')).toContainText('another engine');
});

test('a case that waits for its file still waits for it after a reload', async ({ page }) => {
  await page.goto(link({ ...coarse, source: { file: { name: 'body.nrrd', sha256: '' } }, labels: [] }));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(page.locator('main')).toContainText('body.nrrd');
  await page.waitForTimeout(1500);
  await page.reload();
  await expect(page.locator('main')).toContainText('body.nrrd');
  await dropFile(page, maskFile('body.nrrd'));
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.getByLabel('Edge length', { exact: true })).toHaveValue('6');
});

test('undo in a field shows the number that the recipe has', async ({ page }) => {
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  const field = page.getByLabel('Edge length', { exact: true });
  await field.fill('7');
  await page.keyboard.press('Control+z');
  await expect(field).toHaveValue('6');
});

test('the mesh that is shown can be exported though sizes were painted since', async ({ page }) => {
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await page.getByRole('button', { name: 'Paint…' }).click();
  await page.getByLabel('Edge length painted').fill('3');
  const surface = slice(page, 'axial').locator('.pane-surface');
  await surface.click({ position: { x: 150, y: 130 } });
  await expect(page.getByLabel('Painted edge length 1')).toHaveValue('3');
  await page.getByTestId('run').click();
  await meshed(page);
  await page.getByLabel('Edge length painted').fill('4');
  await surface.click({ position: { x: 100, y: 90 } });
  await expect(page.getByLabel('Painted edge length 2')).toHaveValue('4');
  await idle(page);
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  // Beside the surfaces, which are a file of their own.
  const downloading = page.waitForEvent('download', (one) => one.suggestedFilename() === 'biventricle.vtu');
  await page.getByRole('dialog').getByRole('button', { name: 'Export' }).click();
  await downloading;
  await expect(page.getByRole('alert')).toHaveCount(0);
});

test('a browser without WebGL 2 meshes and writes everything into a zip', async ({ page, complaints }) => {
  await page.addInitScript(() => {
    const usual = HTMLCanvasElement.prototype.getContext as (...args: unknown[]) => unknown;
    HTMLCanvasElement.prototype.getContext = function (
      this: HTMLCanvasElement,
      kind: string,
      ...rest: unknown[]
    ) {
      return kind.startsWith('webgl') ? null : usual.call(this, kind, ...rest);
    } as typeof HTMLCanvasElement.prototype.getContext;
  });
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Open and run' }).click();
  await meshed(page);
  await expect(page.locator('main')).toContainText('no WebGL 2');
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'All in one zip' }).click();
  expect((await downloading).suggestedFilename()).toBe('biventricle.zip');
  await idle(page);
  // three.js tells the console why it draws nothing.
  expect(complaints.filter((text) => !text.includes('WebGL'))).toEqual([]);
  complaints.length = 0;
});

test('on a phone everything of the head line is in reach', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  for (const name of ['Undo', 'Keys', 'Share', 'Export', 'Run'])
    await expect(page.getByRole('button', { name, exact: true })).toBeInViewport({ ratio: 1 });
  const scrollWidth = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(scrollWidth).toBeLessThanOrEqual(390);
});

test('the focus stays where a run begins and ends', async ({ page }) => {
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await page.getByTestId('run').focus();
  await page.keyboard.press('Enter');
  await meshed(page);
  await expect(page.getByTestId('run')).toBeFocused();
});

test('a surface that takes long is stopped by a button that says so', async ({ page }) => {
  await page.goto(
    link({ ...fineHeart, source: { phantom: { kind: 'biventricle', spacing_mm: [0.8, 0.8, 0.8] } } }),
  );
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await idle(page);
  await expect(page.getByRole('button', { name: 'Stop', exact: true })).toHaveCount(0);
});

test('names of files are shown as they are written', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  // With contextual forms Inter draws the x between digits as a times sign, which is wider.
  const [shown, plain, contextual] = await page.evaluate(async () => {
    await document.fonts.load('100px "Inter Variable"');
    return ['', '"calt" 0', '"calt" 1'].map((features) => {
      const name = document.createElement('span');
      name.textContent = '512x512x400';
      Object.assign(name.style, { position: 'absolute', fontSize: '100px', fontFeatureSettings: features });
      document.getElementById('app')!.append(name);
      return name.getBoundingClientRect().width;
    });
  });
  expect(contextual).not.toBeCloseTo(plain, 1);
  expect(shown).toBeCloseTo(plain, 1);
});
