/** "Look at this": a link with its view, as text and as a QR code, and with what was simulated. */
import AxeBuilder from '@axe-core/playwright';
import jsQR from 'jsqr';
import { inflateRawSync } from 'node:zlib';
import type { Page } from '@playwright/test';
import { expect, idle, link, meshed, openAndRun, smallHeart, test } from './support';

const linked = (url: string) =>
  JSON.parse(inflateRawSync(Buffer.from(url.split('#c1=')[1], 'base64url')).toString());

async function share(page: Page, ...options: string[]): Promise<string> {
  await page.getByRole('button', { name: 'Share' }).click();
  const dialog = page.getByRole('dialog');
  const field = dialog.getByTestId('share-link');
  await expect(field).toHaveValue(/#c1=/);
  for (const option of options) {
    const before = await field.inputValue();
    await dialog.getByLabel(option).check();
    await expect(field).not.toHaveValue(before);
  }
  return field.inputValue();
}

test('a link shows what its sender looked at: camera, cut, colour, element', async ({ page }) => {
  await openAndRun(page, smallHeart);
  await page.getByLabel('Colour by').selectOption({ label: 'Smallest dihedral angle' });
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await page.locator('.worst button').first().click();
  await page.waitForTimeout(800);
  const url = await share(page, 'With this view');
  const { view, version } = linked(url);
  expect(version).toBe(2);
  expect(view.element).toBeGreaterThanOrEqual(0);
  expect(view.colour).toBe('min_dihedral_deg');
  expect(view.cut.normal).toHaveLength(3);

  const receiver = await page.context().newPage();
  await receiver.goto(url);
  await receiver.getByRole('button', { name: 'Open and run' }).click();
  await meshed(receiver);
  await expect(receiver.getByTestId('verdict')).toContainText('Reproduced');
  await expect(receiver.getByLabel('Colour by')).toHaveValue('min_dihedral_deg');
  await expect(receiver.getByRole('button', { name: 'Cut', exact: true })).toHaveAttribute(
    'aria-pressed',
    'true',
  );
  await expect(receiver.locator('.picked')).toContainText(view.element.toLocaleString('en'));
  // The camera stands where the sender's stood: what is shared again is the same view.
  const again = linked(await share(receiver, 'With this view')).view;
  expect(again).toEqual(view);
  await receiver.close();
});

test('a QR code holds the link, and a long link says what to send instead', async ({ page }) => {
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  const url = await share(page);
  const dialog = page.getByRole('dialog');
  await dialog.getByRole('button', { name: 'QR code' }).click();
  const canvas = dialog.getByTestId('qr');
  await expect(canvas).toBeVisible();
  await expect.poll(() => canvas.evaluate((c: HTMLCanvasElement) => c.width)).toBeGreaterThan(300);
  const image = await canvas.evaluate((c: HTMLCanvasElement) => {
    const { data, width, height } = c.getContext('2d')!.getImageData(0, 0, c.width, c.height);
    return { data: [...data], width, height };
  });
  expect(jsQR(Uint8ClampedArray.from(image.data), image.width, image.height)?.data).toBe(url);
  const { violations } = await new AxeBuilder({ page }).include('dialog').analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  await page.keyboard.press('Escape');

  const names = Array.from({ length: 400 }, (_, i) => ({
    label: i + 1,
    name: `part ${i * 7919} of ${i * 104729}`,
  }));
  await page.goto(link({ ...smallHeart, legend: names }));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  expect((await share(page)).length).toBeGreaterThan(2000);
  await expect(dialog).toContainText('?case=https://example.org/biventricle.case.json');
  await dialog.getByRole('button', { name: 'QR code' }).click();
  await expect(dialog).toContainText('too many for a QR code');
});

test('a link promises the wave too, and says whether it is reproduced', async ({ page }) => {
  const wave = {
    ...smallHeart,
    physics: {
      tissue: { kinds: [{ labels: [1, 2, 6] }] },
      stimuli: [{ centre_mm: [0, 0, -40], radius_mm: 14 }],
      monodomain: { end_ms: 40, step_ms: 0.1 },
    },
  };
  await openAndRun(page, wave);
  await page.getByTestId('simulate-wave').click();
  await expect(page.locator('.player')).toBeVisible();
  await idle(page);
  const url = await share(page);
  expect(linked(url).expected).toMatchObject({
    stages: { monodomain: expect.stringMatching(/^[0-9a-f]{64}$/) },
  });

  const receiver = await page.context().newPage();
  await receiver.goto(url);
  await receiver.getByRole('button', { name: 'Open and run' }).click();
  await meshed(receiver);
  const verdict = receiver.getByTestId('verdict');
  await expect(verdict).toContainText('The link promises what is simulated on it too');
  await verdict.getByRole('button', { name: 'Simulate it' }).click();
  await expect(verdict).toContainText('Digest of the wave');
  await expect(verdict).toContainText('Reproduced');
  await expect(verdict.locator('tr.other')).toHaveCount(0);
  await receiver.close();
});
