/** The address bar holds the case: over edits, "Not now", a reload, a step back. */
import type { Page } from '@playwright/test';
import { inflateRawSync } from 'node:zlib';
import { expect, idle, link, smallHeart, stage, test } from './support';

const coarse = { source: smallHeart.source, labels: [1, 2], sizing: { edge_mm: 6 } };
const edge = (page: Page) => page.getByLabel('Edge length', { exact: true });

/** The case of the address bar, once the page has written it there. */
function inAddress(page: Page): { sizing?: { edge_mm?: number }; source?: unknown } | null {
  const [, packed] = page.url().split('#c1=');
  return packed ? JSON.parse(inflateRawSync(Buffer.from(packed, 'base64url')).toString()) : null;
}

async function open(page: Page): Promise<void> {
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
}

test('the address follows the case on opening, on an edit and on undo, and a reload goes on with it', async ({
  page,
}) => {
  await open(page);
  await expect.poll(() => inAddress(page)?.sizing?.edge_mm).toBe(6);
  const entries = await page.evaluate(() => history.length);
  await edge(page).fill('7');
  await expect.poll(() => inAddress(page)?.sizing?.edge_mm).toBe(7);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect.poll(() => inAddress(page)?.sizing?.edge_mm).toBe(6);
  await edge(page).fill('8');
  await expect.poll(() => inAddress(page)?.sizing?.edge_mm).toBe(8);
  expect(await page.evaluate(() => history.length)).toBe(entries);
  await page.reload();
  await expect(edge(page)).toHaveValue('8');
  await expect(page.getByRole('dialog')).toHaveCount(0);
  expect(inAddress(page)?.sizing?.edge_mm).toBe(8);
});

test('a link that is not opened now stays in the address, and asks again after a reload', async ({
  page,
}) => {
  await page.goto(link(coarse));
  await page.getByRole('button', { name: 'Not now' }).click();
  await idle(page);
  await page.waitForTimeout(1000);
  expect(page.url()).toContain(link(coarse).slice(2));
  await page.reload();
  await expect(page.getByRole('dialog')).toContainText('Open this case?');
});

test('another case is another step of the browser, and back leads to the one before', async ({ page }) => {
  await open(page);
  await expect.poll(() => inAddress(page)?.sizing?.edge_mm).toBe(6);
  await page.getByRole('button', { name: 'Examples…' }).click();
  await page.getByRole('dialog').getByRole('button', { name: /Torus/ }).click();
  await expect.poll(() => inAddress(page)?.sizing?.edge_mm).toBe(3);
  await page.goBack();
  await expect(page.getByRole('dialog')).toContainText('Open this case?');
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(edge(page)).toHaveValue('6');
});
