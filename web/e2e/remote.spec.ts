/** Files from elsewhere: nothing is fetched before a click that shows the host. */
import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { labelledFile } from './files';
import { dropFile, expect, idle, link, stage, test } from './support';

const host = 'https://data.example/';
test.use({ otherHost: host });

const body = () =>
  labelledFile('body.nrrd', [24, 24, 24], [2, 2, 2], (i, j, k) =>
    Number(Math.hypot(i - 11.5, j - 11.5, k - 11.5) < 8),
  );

/** The host, which lets every page read; how often it was asked. */
async function serve(page: Page, content: () => Buffer): Promise<() => number> {
  let asked = 0;
  await page.route(`${host}**`, (route) => {
    asked++;
    return route.fulfill({ body: content(), headers: { 'Access-Control-Allow-Origin': '*' } });
  });
  return () => asked;
}

test('a volume is fetched after a click, and its link tells others where to fetch it', async ({
  page,
  browser,
}) => {
  const file = body();
  const asked = await serve(page, () => readFileSync(file));
  await page.goto(`./?volume=${encodeURIComponent(`${host}body.nrrd`)}`);
  const dialog = page.getByRole('dialog');
  await expect(dialog).toContainText('data.example');
  await idle(page);
  expect(asked()).toBe(0);
  await dialog.getByRole('button', { name: 'Fetch it from data.example' }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  expect(asked()).toBe(1);
  await expect.poll(() => page.evaluate(() => location.search)).toBe('');
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByTestId('share-link')).toHaveValue(/#c1=/);
  const shared = await page.getByTestId('share-link').inputValue();

  const receiver = await (await browser.newContext()).newPage();
  const fetched = await serve(receiver, () => readFileSync(file));
  await receiver.goto(shared);
  await receiver.getByRole('dialog').getByRole('button', { name: 'Open', exact: true }).click();
  await receiver.getByRole('button', { name: 'fetch it', exact: true }).click();
  expect(fetched()).toBe(0);
  await receiver.getByRole('button', { name: 'Fetch it from data.example' }).click();
  await expect(stage(receiver, 'smooth')).toHaveAttribute('data-state', 'done');
  await receiver.context().close();
});

test('a case is fetched, and asked about like that of a link', async ({ page }) => {
  const recipe = { source: { phantom: { kind: 'sphere', radius_mm: 20 } }, sizing: { edge_mm: 6 } };
  await serve(page, () => Buffer.from(JSON.stringify(recipe)));
  await page.goto(`./?case=${encodeURIComponent(`${host}ball.case.json`)}`);
  await page.getByRole('button', { name: 'Fetch it from data.example' }).click();
  await expect(page.getByRole('dialog')).toContainText('generated: sphere');
});

test('an address within a network is not asked, and the file of a link is not another one', async ({
  page,
}) => {
  await page.goto(`./?volume=${encodeURIComponent('https://192.168.0.1/heart.nii')}`);
  const dialog = page.getByRole('dialog');
  await expect(dialog.getByRole('alert')).toContainText('public host');
  await expect(dialog.getByRole('button', { name: /Fetch it/ })).toHaveCount(0);
  await dialog.getByRole('button', { name: 'Not now' }).click();
  await serve(page, () => readFileSync(body()));
  const file = { name: 'body.nrrd', sha256: '0'.repeat(64), url: `${host}body.nrrd` };
  await page.goto(link({ source: { file } }));
  await page.getByRole('dialog').getByRole('button', { name: 'Open', exact: true }).click();
  await page.getByRole('button', { name: 'fetch it', exact: true }).click();
  await page.getByRole('button', { name: 'Fetch it from data.example' }).click();
  await expect(page.getByRole('alert')).toContainText('This is not the expected volume');
  await dropFile(page, body());
  await expect(page.getByRole('alert').first()).toContainText('This is not the expected volume');
});
