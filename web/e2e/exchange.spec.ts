/** What comes in and goes out as files: DICOM segmentation objects, a zip of everything. */
import { readFile, writeFile } from 'node:fs/promises';
import { strFromU8, unzipSync } from 'fflate';
import type { Page } from '@playwright/test';
import { dicomSegmentation } from './files';
import { dropFile, expect, idle, link, meshed, slice, smallHeart, stage, tetCount, test } from './support';

/** The digest of the volume that the case stands on, as its case file has it. */
async function sourceDigest(page: Page): Promise<string> {
  await page.getByRole('button', { name: 'Share' }).click();
  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Case file (JSON)' }).click();
  const { source } = JSON.parse(await readFile(await (await downloading).path(), 'utf8'));
  await page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
  return source.file.sha256;
}

test('a DICOM segmentation object is read with its names, colours and place, from our own origin', async ({
  page,
}) => {
  const files = dicomSegmentation();
  test.skip(files === null, 'pydicom is not on this machine.');
  await page.goto('./');
  await idle(page);
  await dropFile(page, files!.dicom);
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  const rows = page.locator('.labels tbody tr');
  await expect(rows).toHaveCount(2);
  await expect(rows.first().getByLabel(/^Name of label/)).toHaveValue('Left ventricle wall');
  await expect(page.getByLabel('Colour of Left ventricle blood')).toHaveValue('#0000ff');
  await expect(page.locator('.read-facts')).toContainText('24 × 20 × 12');
  const digest = await sourceDigest(page);
  await dropFile(page, files!.nrrd);
  await page.getByRole('button', { name: /Open it/ }).click();
  await expect(page.locator('.source-name')).toContainText('heart.nrrd');
  await idle(page);
  expect(await sourceDigest(page)).toBe(digest);
});

test('another DICOM file is refused with its name', async ({ page, complaints }, testInfo) => {
  const path = testInfo.outputPath('photo.dcm');
  await writeFile(
    path,
    Buffer.concat([Buffer.alloc(128), Buffer.from('DICM nothing that follows makes sense')]),
  );
  await page.goto('./');
  await idle(page);
  await dropFile(page, path);
  await expect(page.getByRole('alert')).toContainText(
    'photo.dcm cannot be read as a DICOM segmentation object',
  );
  await idle(page);
  // DCMTK tells the console what it thinks of the file.
  expect(complaints.filter((text) => !text.startsWith('error:'))).toEqual([]);
  complaints.length = 0;
});

test('a zip holds mesh, report, case and painted mask, and opens again as the same case', async ({
  page,
}) => {
  await page.goto(link({ source: smallHeart.source, labels: [1, 2], sizing: { edge_mm: 6 } }));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await page.getByRole('button', { name: 'Paint…' }).click();
  await page.getByLabel('Edge length painted').fill('3');
  await slice(page, 'axial')
    .locator('.pane-surface')
    .click({ position: { x: 150, y: 130 } });
  await expect(page.getByLabel('Painted edge length 1')).toHaveValue('3');
  await page.getByTestId('run').click();
  await meshed(page);
  const tets = await tetCount(page);
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'All in one zip' }).click();
  const download = await downloading;
  expect(download.suggestedFilename()).toBe('biventricle.zip');
  const path = await download.path();
  const entries = unzipSync(await readFile(path));
  expect(Object.keys(entries).sort()).toEqual([
    'biventricle.case.json',
    'biventricle.report.html',
    'biventricle.report.json',
    // The walls towards the blood that is not meshed.
    'biventricle.surfaces.vtu',
    'biventricle.vtu',
    'painted.nrrd',
    'ro-crate-metadata.json',
  ]);
  const report = JSON.parse(strFromU8(entries['biventricle.report.json']));
  expect(report.tets).toBe(tets);
  expect(JSON.parse(strFromU8(entries['biventricle.case.json'])).expected.digest).toBe(report.digest);
  expect(strFromU8(entries['biventricle.vtu'].subarray(0, 200))).toContain('VTKFile');

  await page.goto('about:blank');
  await page.goto('./');
  await idle(page);
  await page
    .getByTestId('file-input')
    .first()
    .setInputFiles({
      name: 'case.zip',
      mimeType: 'application/zip',
      buffer: await readFile(path),
    });
  await page.getByRole('dialog').getByRole('button', { name: 'Open and run' }).click();
  await meshed(page);
  await expect(page.getByTestId('verdict')).toContainText('Reproduced');
  await expect(page.getByLabel('Painted edge length 1')).toHaveValue('3');
});
