/** Sizes beyond labels and regions: walls by their thickness, distances as colours. */
import { expect, idle, link, meshed, openAndRun, sampled, smallHeart, test } from './support';

test('the distance to the labels is a colour and a number of the element that is clicked', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  const labels = await sampled(page, 'model');
  await page.getByLabel('Colour by').selectOption('distance_mm');
  await expect(page.locator('.legend')).toContainText('Distance to the label surface mm');
  expect(await sampled(page, 'model')).not.toEqual(labels);
  const model = page.locator('.pane.model .pane-surface');
  const box = (await model.boundingBox())!;
  await model.click({ position: { x: box.width * 0.5, y: box.height * 0.6 } });
  await expect(page.locator('.picked')).toContainText(/To the labels\s*0\.\d+ mm \(0\.\d+ voxels\)/);
});

test('a wall is sized by its thickness, which is seen on slices and surface before meshing', async ({
  page,
}) => {
  await page.goto(link({ source: smallHeart.source, labels: [1, 2], sizing: { edge_mm: 6 } }));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  const before = await sampled(page, 'model');
  await page.getByRole('button', { name: 'Wall', exact: true }).click();
  const wall = page.getByRole('group', { name: 'Wall', exact: true });
  await wall.getByRole('button', { name: 'RV myocardium' }).click();
  const inside = page.getByRole('group', { name: 'Inside of it' });
  // What is inside of the left wall is proposed.
  await expect(inside.getByRole('button', { name: 'LV blood' })).toHaveAttribute('aria-pressed', 'true');
  await inside.getByRole('button', { name: 'RV blood' }).click();
  await page.getByLabel('Colour by').selectOption('thickness_mm');
  await expect(page.locator('.legend')).toContainText('Wall thickness mm');
  const measured = page.getByText(/Measured: .* mm/);
  await expect(measured).toBeVisible();
  const [, range] = /Measured: (.*) mm/.exec(await measured.innerText())!;
  await expect(page.locator('.legend-range')).toHaveText(range);
  const thickness = await sampled(page, 'model');
  expect(thickness).not.toEqual(before);
  await page.getByLabel('Colour by').selectOption('target_mm');
  await expect(page.locator('.legend')).toContainText('Target edge length mm');
  expect(await sampled(page, 'model')).not.toEqual(thickness);

  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  const overlay = page.getByRole('group', { name: 'Slices show' });
  const shown: unknown[] = [];
  for (const name of ['Labels', 'Edge length', 'Thickness']) {
    await overlay.getByRole('button', { name }).click();
    const now = await sampled(page, 'coronal');
    for (const other of shown) expect(now).not.toEqual(other);
    shown.push(now);
  }
  await expect(page.getByRole('img', { name: /Wall thickness from/ })).toBeVisible();

  await page.getByRole('group', { name: 'Size by' }).getByRole('button', { name: 'Layers' }).click();
  await page.getByLabel('LV myocardium, RV myocardium: Elements across').fill('2');
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.getByTestId('layers').locator('tbody tr')).toHaveCount(1);
  await page.getByLabel('Exactly so many').check();
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.getByTestId('layers').locator('tbody tr')).toContainText(/9\d\.?\d* %|100 %/);
  const meshColours = await sampled(page, 'model');
  await page.getByLabel('Colour by').selectOption({ label: 'Layer, from the inner surface' });
  await expect(page.getByRole('img', { name: 'Layer, from the inner surface from 1 to 2' })).toBeVisible();
  expect(await sampled(page, 'model')).not.toEqual(meshColours);
  await page.getByLabel('Colour by').selectOption({ label: 'Layers across the wall' });
  await expect(page.getByRole('img', { name: /Layers across the wall from/ })).toBeVisible();
  await page.getByRole('button', { name: 'Remove LV myocardium, RV myocardium' }).click();
  const changed = page.getByText('The recipe has changed since this mesh was made.');
  await expect(changed).toBeVisible();
  await page.keyboard.press('Control+z');
  await expect(changed).toHaveCount(0);
});
