/** Theme and size of type. */
import type { Page } from '@playwright/test';
import { expect, meshed, openAndRun, smallHeart, test } from './support';

/** What stands side by side and lies on each other, or is cut off by what holds it. */
const collisions = (page: Page): Promise<string[]> =>
  page.evaluate(() => {
    const found: string[] = [];
    const shown = (element: Element) =>
      element.checkVisibility() && element.getBoundingClientRect().width > 0;
    for (const row of document.querySelectorAll('.header, .toolbar, .pipeline ol, .field, .section-head')) {
      const outer = row.getBoundingClientRect();
      const parts = [...row.children].filter((part) => shown(part) && !part.matches('[popover], .spacer'));
      const boxes = parts.map((part) => part.getBoundingClientRect());
      boxes.forEach((a, i) => {
        const name = `${row.className}: ${parts[i].textContent?.slice(0, 30) || parts[i].className}`;
        if (a.left < outer.left - 1 || a.right > outer.right + 1) found.push(`${name} leaves it`);
        for (const b of boxes.slice(i + 1)) {
          // Stages are arrows that reach into each other.
          const reach = row.matches('ol') ? 10 : 1;
          const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
          const tall = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
          if (wide > reach && tall > reach) found.push(`${name} is under its neighbour`);
        }
      });
    }
    return found;
  });

const heightOf = async (page: Page, selector: string) =>
  (await page.locator(selector).first().boundingBox())!.height;

test('large type is a third larger, is kept, and nothing lies on anything else at 1280 x 800', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  const selectors = ['.source-buttons .button', '.worst button', '.header .button'];
  const before = await Promise.all(selectors.map((selector) => heightOf(page, selector)));
  await page.getByRole('button', { name: 'Appearance' }).click();
  await page.getByLabel('Large type').check();
  await page.keyboard.press('Escape');
  await expect(page.getByLabel('Large type')).toBeHidden();
  const larger = async () => {
    for (const [i, selector] of selectors.entries())
      expect((await heightOf(page, selector)) / before[i]).toBeCloseTo(1.3, 1);
  };
  await larger();
  await page.reload();
  await expect(page.getByTestId('run')).toBeEnabled();
  await page.getByTestId('run').click();
  await meshed(page);
  await larger();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await expect(page.getByLabel('Place of the cut')).toBeVisible();
  expect(await collisions(page)).toEqual([]);
  const scrolled = await page.evaluate(() => {
    const { scrollWidth, scrollHeight } = document.documentElement;
    return [scrollWidth, scrollHeight];
  });
  expect(scrolled).toEqual([1280, 800]);
});

test('with large type a click in the view and a drag over a histogram hit what they point at', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Appearance' }).click();
  await page.getByLabel('Large type').check();
  await page.keyboard.press('Escape');
  await page.waitForTimeout(500);
  const view = (await page.locator('.view-host').boundingBox())!;
  const canvas = (await page.locator('.view-canvas').boundingBox())!;
  expect(canvas.width).toBeCloseTo(view.width, 0);
  await page.mouse.click(view.x + view.width / 2, view.y + view.height / 2);
  await expect(page.locator('.picked')).toContainText('Tetrahedron');

  const chart = page.locator('.chart.brushable .u-over').first();
  await chart.scrollIntoViewIfNeeded();
  const box = (await chart.boundingBox())!;
  const [from, to] = [box.x + 0.2 * box.width, box.x + 0.7 * box.width];
  await page.mouse.move(from, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(to, box.y + 40, { steps: 6 });
  await page.mouse.up();
  await expect(page.getByTestId('brush-count')).toHaveText(/[1-9][\d,]* elements/);
  const selected = (await page.locator('.chart.brushable .u-select').first().boundingBox())!;
  expect(Math.abs(selected.x - from)).toBeLessThan(3);
  expect(Math.abs(selected.x + selected.width - to)).toBeLessThan(3);
});

test('the theme is that of the system until another one is chosen', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto('./');
  const root = page.locator('html');
  await expect(root).toHaveAttribute('data-theme', 'dark');
  await page.getByRole('button', { name: 'Appearance' }).click();
  await page.getByRole('button', { name: 'Light', exact: true }).click();
  await expect(root).toHaveAttribute('data-theme', 'light');
  await page.reload();
  await expect(root).toHaveAttribute('data-theme', 'light');
  await page.getByRole('button', { name: 'Appearance' }).click();
  await page.getByRole('button', { name: 'System', exact: true }).click();
  await expect(root).toHaveAttribute('data-theme', 'dark');
});
