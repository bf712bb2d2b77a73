/** With fingers: on a phone and on a tablet held upright. */
import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, idle, link, smallHeart, stage, test } from './support';

const screens = {
  phone: { width: 390, height: 844 },
  tablet: { width: 820, height: 1180 },
};

const tab = (page: Page, name: string) => page.getByRole('tab', { name });

/** A finger that the page is too busy to see lifted is taken for one that rests; one would tap again. */
async function choose(page: Page, name: string): Promise<void> {
  await expect(async () => {
    await tab(page, name).tap();
    await expect(tab(page, name)).toHaveAttribute('aria-selected', 'true', { timeout: 2000 });
  }).toPass();
}

/** What can be hit and is smaller than a finger. A checkbox is as large as its label. */
const tooSmall = (page: Page): Promise<string[]> =>
  page.evaluate(() =>
    [...document.querySelectorAll('button, select, input, textarea, summary, [role=tab]')]
      .filter((element) => element.checkVisibility({ visibilityProperty: true }))
      .flatMap((element) => {
        const target = element.matches('[type=checkbox], [type=radio]')
          ? (element.closest('label') ?? element)
          : element;
        const { width, height } = target.getBoundingClientRect();
        return width >= 43.5 && height >= 43.5
          ? []
          : [`${element.outerHTML.slice(0, 90)}: ${Math.round(width)} x ${Math.round(height)}`];
      }),
  );

/** Fingers that go down, move and lift, where a tap is not enough. */
async function fingers(page: Page) {
  const session = await page.context().newCDPSession(page);
  return (type: 'touchStart' | 'touchMove' | 'touchEnd', touchPoints: { x: number; y: number }[]) =>
    session.send('Input.dispatchTouchEvent', { type, touchPoints });
}

async function fits(page: Page): Promise<void> {
  const [scrolled, seen] = await page.evaluate(() => {
    const { scrollWidth, scrollHeight, clientWidth, clientHeight } = document.documentElement;
    return [
      [scrollWidth, scrollHeight],
      [clientWidth, clientHeight],
    ];
  });
  expect(scrolled).toEqual(seen);
}

async function serious(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(' ')).join(', ')}`);
}

for (const [name, viewport] of Object.entries(screens)) {
  test.describe(name, () => {
    test.use({ viewport, hasTouch: true, isMobile: true });

    test('from a link to the worst element, a link and a file, by fingers alone', async ({ page }) => {
      await page.goto(link(smallHeart));
      await page.getByRole('button', { name: 'Open', exact: true }).tap();
      await idle(page);
      await page.getByTestId('run').tap();
      await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done');
      await idle(page);

      await choose(page, 'Evidence');
      await expect(page.getByTestId('tets')).toBeInViewport();
      const worst = page.locator('.worst button');
      await worst.nth(1).tap();
      await expect(worst.nth(1)).toHaveAttribute('aria-current', 'true');
      await expect(page.locator('.picked')).toBeInViewport();

      await choose(page, 'View');
      await page.getByRole('button', { name: 'Slices', exact: true }).tap();
      for (const pane of ['axial', 'coronal', 'sagittal'])
        await expect(page.locator(`.pane.${pane}`)).toBeInViewport();

      await page.getByRole('button', { name: 'Share', exact: true }).tap();
      await expect(page.getByTestId('share-link')).toHaveValue(/#c1=/);
      await page.getByRole('button', { name: 'Close' }).last().tap();
      await page.getByRole('button', { name: 'Export', exact: true }).tap();
      // The surfaces towards what is not meshed are a file of their own, which may come first.
      const downloading = page.waitForEvent(
        'download',
        (one) => one.suggestedFilename() === 'biventricle.vtu',
      );
      await page.getByRole('dialog').getByRole('button', { name: 'Export' }).tap();
      await downloading;
    });

    test('whatever can be hit is as large as a finger, and Run is in reach of every tab', async ({
      page,
    }) => {
      await page.goto(link(smallHeart));
      await page.getByRole('button', { name: 'Open and run' }).tap();
      await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done');
      await idle(page);
      for (const part of ['Case', 'View', 'Evidence']) {
        await choose(page, part);
        await expect(page.getByTestId('run')).toBeInViewport({ ratio: 1 });
        expect(await tooSmall(page)).toEqual([]);
        await fits(page);
      }
      await choose(page, 'Case');
      for (const fields of ['Stage parameters', 'Shape of the body', 'Bounds'])
        await page.getByText(fields, { exact: true }).tap();
      await page.getByRole('button', { name: 'Sphere', exact: true }).tap();
      expect(await tooSmall(page)).toEqual([]);
    });

    test('a finger that goes sideways over a histogram chooses elements', async ({ page }) => {
      await page.goto(link(smallHeart));
      await page.getByRole('button', { name: 'Open and run' }).tap();
      await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done');
      await idle(page);
      await choose(page, 'Evidence');
      const chart = page.locator('.chart.brushable .u-over').first();
      await chart.scrollIntoViewIfNeeded();
      const box = (await chart.boundingBox())!;
      const touch = await fingers(page);
      const at = (x: number) => [{ x: box.x + x * box.width, y: box.y + 40 }];
      await touch('touchStart', at(0.1));
      for (const x of [0.2, 0.3, 0.45]) await touch('touchMove', at(x));
      await touch('touchEnd', []);
      await expect(page.getByTestId('brush-count')).toHaveText(/[1-9][\d,]* elements/);
      await choose(page, 'View');
      await page.getByRole('button', { name: 'Show all', exact: true }).tap();
      await choose(page, 'Evidence');
      await expect(page.getByTestId('brush-count')).toHaveCount(0);
    });

    test('what a field means is told on a tap, what a button does by a resting finger', async ({ page }) => {
      await page.goto(link(smallHeart));
      await page.getByRole('button', { name: 'Open', exact: true }).tap();
      await idle(page);
      await choose(page, 'Case');
      const explanation = page.locator('.explanation');
      await page.getByRole('button', { name: 'What is Growth per mm?' }).tap();
      await expect(explanation).toBeInViewport({ ratio: 1 });
      await expect(explanation).toContainText('edge length');
      await page.getByRole('heading', { name: 'Element size' }).tap();
      await expect(explanation).toBeHidden();

      await choose(page, 'View');
      const cut = page.getByRole('button', { name: 'Cut', exact: true });
      const { x, y, width, height } = (await cut.boundingBox())!;
      const touch = await fingers(page);
      await touch('touchStart', [{ x: x + width / 2, y: y + height / 2 }]);
      await expect(explanation).toContainText('Cut the body open');
      await touch('touchEnd', []);
      await expect(cut).toHaveAttribute('aria-pressed', 'false');
      await expect(explanation).toBeVisible();
    });

    test('all stages are seen, and each can be run to', async ({ page }) => {
      await page.goto(link(smallHeart));
      await page.getByRole('button', { name: 'Open', exact: true }).tap();
      await idle(page);
      const line = page.locator('.pipeline-now');
      if (name === 'phone') {
        await expect(line).toContainText('Smooth');
        await line.tap();
      }
      await expect(page.locator('.chip')).toHaveCount(7);
      for (const chip of await page.locator('.chip').all()) await expect(chip).toBeInViewport({ ratio: 1 });
      await page.getByRole('button', { name: 'Run to Remesh' }).tap();
      await expect(stage(page, 'remesh')).toHaveAttribute('data-state', 'done');
    });

    for (const colorScheme of ['light', 'dark'] as const)
      test(`no serious accessibility finding on any tab (${colorScheme})`, async ({ page }) => {
        await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
        await page.goto('./');
        await idle(page);
        expect(await serious(page)).toEqual([]);
        await page.goto(link(smallHeart));
        await page.getByRole('button', { name: 'Open and run' }).tap();
        await expect(stage(page, 'quality')).toHaveAttribute('data-state', 'done');
        await idle(page);
        for (const part of ['Case', 'View', 'Evidence']) {
          await choose(page, part);
          expect(await serious(page)).toEqual([]);
        }
        if (name === 'phone') {
          await page.locator('.pipeline-now').tap();
          expect(await serious(page)).toEqual([]);
        }
        await page.getByRole('button', { name: 'Appearance' }).tap();
        expect(await serious(page)).toEqual([]);
      });
  });
}

test('tabs are gone through by arrow keys in a narrow window', async ({ page }) => {
  await page.setViewportSize({ width: 700, height: 700 });
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await tab(page, 'View').focus();
  const steps = [
    ['ArrowRight', 'Evidence'],
    ['ArrowRight', 'Case'],
    ['ArrowLeft', 'Evidence'],
    ['Home', 'Case'],
    ['End', 'Evidence'],
  ];
  for (const [key, name] of steps) {
    await page.keyboard.press(key);
    await expect(tab(page, name)).toBeFocused();
    await expect(page.getByRole('tabpanel', { name })).toBeVisible();
    await expect(page.getByRole('tab', { selected: true })).toHaveText(name);
  }
});
