/** What real segmentations need: noise taken away, and slices put back, on one click. */
import { bodyFile, layeredFile } from './files';
import { dropFile, expect, idle, stage, test } from './support';

const shots = process.env.VOXTET_SHOTS;

test('noise is named, and cleaned on one click', async ({ page }) => {
  const specks = new Set(['2,2,2', '2,20,5', '25,3,9', '4,25,25', '26,26,4']);
  const noisy = bodyFile('noisy.nrrd', [30, 30, 30], [2, 2, 2], (i, j, k) => {
    const radius = Math.hypot(i - 14.5, j - 14.5, k - 14.5);
    return radius < 9 || specks.has([i, j, k].join());
  });
  await page.goto('./');
  await dropFile(page, noisy);
  const flaws = page.getByTestId('flaws');
  await expect(flaws).toContainText('5 loose pieces of label 1');
  await expect(page.getByText('5 loose pieces')).toHaveCount(1);
  if (shots) await page.screenshot({ path: `${shots}/flaws.png` });
  await flaws.getByRole('button', { name: 'Clean the labels' }).click();
  await expect(flaws).toHaveCount(0);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
});

test('a stack of shifted slices is put back by its preset, and the moves are told', async ({ page }) => {
  const shift = [0, 3, -3, 2, -3, 3, -2, 3, -3, 0];
  const stack = bodyFile('stack.nrrd', [48, 48, 10], [1.5, 1.5, 8], (i, j, k) => {
    const across = Math.hypot((i - 24 - shift[k]) * 1.5, (j - 24 + shift[k]) * 1.5);
    const outer = 26 * Math.sqrt(1 - ((k - 4.5) / 5.6) ** 2);
    return across < outer && across > outer - 11;
  });
  await page.goto('./');
  await dropFile(page, stack);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.getByText('--align-slices')).toBeVisible();
  await page.getByRole('button', { name: 'Thick stack' }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done', { timeout: 120_000 });
  await idle(page);
  const moved = page.getByTestId('alignment');
  await expect(moved.locator('tbody tr').nth(5)).toBeVisible();
  if (shots) await moved.scrollIntoViewIfNeeded();
  if (shots) await page.screenshot({ path: `${shots}/stack.png` });
});

test('a file can be read another way', async ({ page }) => {
  const ball = bodyFile(
    'ball.nrrd',
    [20, 20, 20],
    [2, 2, 2],
    (i, j, k) => Math.hypot(i - 10, j - 10, k - 10) < 6,
  );
  await page.goto('./');
  await dropFile(page, ball);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await page.getByRole('button', { name: 'How it is read' }).click();
  const dialog = page.getByRole('dialog');
  await expect(dialog).toBeVisible();
  if (shots) await page.screenshot({ path: `${shots}/reading.png` });
});

test('a segment that others hide is dragged above them', async ({ page }) => {
  await page.goto('./');
  await dropFile(page, layeredFile('layers.seg.nrrd'));
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await expect(page.getByText('SEGMENT LOST').first()).toBeVisible();
  await page.getByRole('button', { name: 'How it is read' }).click();
  const order = page.getByRole('dialog').getByRole('listitem');
  await expect(order).toHaveText([/inner/, /outer/]);
  await order.nth(1).dragTo(order.nth(0));
  await expect(order).toHaveText([/outer/, /inner/]);
  await order.nth(1).dragTo(order.nth(0));
  await expect(order).toHaveText([/inner/, /outer/]);
  await page.getByRole('button', { name: 'Read it so' }).click();
  await expect(page.getByText('SEGMENT LOST')).toHaveCount(0);
  await idle(page);

  await expect(page.getByLabel('Mesh inner')).toBeChecked();
});
