/** Where the focus goes when what had it is gone, and what one Tab skips. */
import { expect, idle, link, meshed, openAndRun, smallHeart, stage, test } from './support';

test('an example opened by Enter leaves the focus on Run, and the run leaves it there', async ({ page }) => {
  await page.goto('./');
  await idle(page);
  await page.getByRole('button', { name: /Branching tube/ }).focus();
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('run')).toBeFocused();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await expect(page.getByTestId('run')).toBeFocused();
  await page.keyboard.press('Control+Enter');
  await meshed(page);
  await expect(page.getByTestId('run')).toBeFocused();
});

test('a case opened from a link leaves the focus on Run', async ({ page }) => {
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open', exact: true }).focus();
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('run')).toBeFocused();
});

test('the list of worst elements is one stop of Tab, and arrows, Home and End go along it', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  const rows = page.locator('.worst button');
  const last = (await rows.all()).length - 1;
  expect(last).toBeGreaterThan(5);
  await expect(page.locator('.worst [tabindex="0"]')).toHaveCount(1);
  await rows.first().focus();
  const steps: [string, number][] = [
    ['ArrowDown', 1],
    ['ArrowDown', 2],
    ['ArrowUp', 1],
    ['End', last],
    ['ArrowDown', last],
    ['Home', 0],
  ];
  for (const [key, row] of steps) {
    await page.keyboard.press(key);
    await expect(rows.nth(row)).toBeFocused();
    await expect(rows.nth(row)).toHaveAttribute('aria-current', 'true');
    await expect(page.locator('.worst [tabindex="0"]')).toHaveCount(1);
  }
  await page.keyboard.press('Tab');
  await expect(page.locator('.worst button:focus')).toHaveCount(0);
  await page.keyboard.press('Shift+Tab');
  await expect(rows.first()).toBeFocused();
});
