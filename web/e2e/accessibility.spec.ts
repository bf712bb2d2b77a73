/** For whoever has no mouse, and whoever does not see the page. */
import AxeBuilder from '@axe-core/playwright';
import { maskFile } from './files';
import { dropFile, expect, idle, meshed, openAndRun, slice, smallHeart, stage, test } from './support';

for (const colorScheme of ['light', 'dark'] as const) {
  test(`no serious accessibility finding on any panel (${colorScheme})`, async ({ page }) => {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    await page.goto('./');
    await idle(page);
    const serious = async () => {
      const { violations } = await new AxeBuilder({ page }).analyze();
      return violations
        .filter((finding) => finding.impact === 'serious' || finding.impact === 'critical')
        .map((finding) => `${finding.id}: ${finding.nodes.map((node) => node.target.join(' ')).join(', ')}`);
    };
    expect(await serious()).toEqual([]);
    await openAndRun(page, smallHeart);
    await page.getByRole('button', { name: 'Pin this run' }).click();
    await page.getByRole('button', { name: 'Sphere', exact: true }).click();
    await page.getByRole('button', { name: 'Wall', exact: true }).click();
    await page.getByRole('button', { name: 'Curvature', exact: true }).click();
    await page.getByText('Stage parameters').click();
    await page.getByText('Limits', { exact: true }).click();
    await page.getByLabel('Limits: Most tetrahedra').fill('10');
    await expect(page.locator('.panel.left .stale', { hasText: 'limits.tets' })).toBeVisible();
    await page.getByText('Shape of the tetrahedra').click();
    await page.getByRole('button', { name: 'Cut', exact: true }).click();
    await page.getByLabel('Colour by').selectOption('size_log2');
    await page.locator('.worst button').first().click();
    expect(await serious()).toEqual([]);
    await page.getByLabel('Limits: Most tetrahedra').fill('0');
    await page.getByTestId('run').click();
    await meshed(page);
    for (const layout of ['Slices', 'Compare']) {
      await page.getByRole('button', { name: layout, exact: true }).click();
      expect(await serious()).toEqual([]);
    }
    await page.getByRole('button', { name: 'Paint…' }).click();
    await slice(page, 'axial').locator('.pane-surface').click();
    await expect(page.getByLabel('Painted edge length 1')).toBeVisible();
    await dropFile(page, maskFile('mask.nrrd'));
    await expect(page.getByRole('dialog')).toBeVisible();
    expect(await serious()).toEqual([]);
    await page.getByRole('button', { name: /Mask of sizes/ }).click();
    await page.getByRole('button', { name: /^mask.nrrd/ }).click();
    expect(await serious()).toEqual([]);
    for (const name of ['Share', 'Export', 'Examples…', 'Keys', 'By number…']) {
      await page.getByRole('button', { name }).first().click();
      await expect(page.getByRole('dialog')).toBeVisible();
      expect(await serious()).toEqual([]);
      await page.keyboard.press('Escape');
    }
  });
}

test('from an example to the numbers of one element without a mouse', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  const reach = async (name: string | RegExp) => {
    const wanted = page.getByRole('button', { name }).first();
    for (let i = 0; i < 120; i++) {
      if (await wanted.evaluate((element) => element === document.activeElement)) return;
      await page.keyboard.press('Tab');
    }
    throw new Error(`Tab does not reach ${name}`);
  };
  await reach(/Branching tube/);
  await page.keyboard.press('Enter');
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByLabel('Edge length', { exact: true }).focus();
  await page.keyboard.press('Control+A');
  await page.keyboard.type('6');
  await page.keyboard.press('Control+Enter');
  await meshed(page);
  await page.locator('.pane.model .pane-surface').focus();
  await page.keyboard.press('Enter');
  await expect(page.locator('.picked')).toContainText('Tetrahedron');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Escape');
  await expect(page.locator('.picked')).toHaveCount(0);
  await reach(/give a range of mean edge/);
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('brush-count')).toHaveText(/[1-9][\d,]* elements/);
  await page.keyboard.press('Escape');
  await expect(page.getByTestId('brush-count')).toHaveCount(0);
  await page.locator('.pane.model .pane-surface').focus();
  await page.keyboard.type('?');
  await expect(page.getByRole('dialog')).toContainText('Undo, redo');
  await page.keyboard.press('Control+z');
  await expect(page.getByLabel('Edge length', { exact: true })).toHaveValue('6');
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toHaveCount(0);
});
