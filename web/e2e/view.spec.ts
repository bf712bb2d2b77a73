/** The view: slices and their crosshair, cuts, colours, picking. */
import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { expect, idle, link, openAndRun, sampled, slice, smallHeart, stage, test } from './support';

const place = (page: Page, name: string) => slice(page, name).locator('.pane-place');

async function openSlices(page: Page, recipe: object): Promise<void> {
  await page.goto('about:blank');
  await page.goto(link(recipe));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  await expect(place(page, 'axial')).toContainText('mm');
  await page.getByRole('button', { name: 'Edges', exact: true }).click();
}

test('slices show the patient the same way round, however the image is stored', async ({ page }) => {
  const phantom = { kind: 'biventricle', scar: true, spacing_mm: [3, 3, 3] };
  await openSlices(page, { source: { phantom } });
  const sides = async (name: string) => slice(page, name).locator('.side').allInnerTexts();
  const expected = { axial: 'R,L,A,P', coronal: 'R,L,S,I', sagittal: 'A,P,S,I' };
  const colours: Record<string, number[][]> = {};
  for (const [name, letters] of Object.entries(expected)) {
    expect((await sides(name)).join()).toBe(letters);
    colours[name] = await sampled(page, name);
    expect(new Set(colours[name].map(String)).size).toBeGreaterThan(2);
  }
  await openSlices(page, { source: { phantom: { ...phantom, mirrored: true } } });
  for (const [name, letters] of Object.entries(expected)) {
    expect((await sides(name)).join()).toBe(letters);
    // Of an even number of voxels the middle one is another from the other end.
    if (name !== 'sagittal') expect(await sampled(page, name)).toEqual(colours[name]);
  }
});

test('one crosshair goes through the three slices and the 3-D view, by mouse, wheel and keys', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  const before = {
    coronal: await place(page, 'coronal').innerText(),
    axial: await place(page, 'axial').innerText(),
  };
  await slice(page, 'axial')
    .locator('.pane-surface')
    .click({ position: { x: 120, y: 130 } });
  await expect(place(page, 'coronal')).not.toHaveText(before.coronal);
  await expect(place(page, 'axial')).toHaveText(before.axial);
  await page.mouse.wheel(0, 100);
  await expect(place(page, 'axial')).not.toHaveText(before.axial);
  await page.mouse.wheel(0, -100);
  await expect(place(page, 'axial')).toHaveText(before.axial);
  await slice(page, 'coronal').locator('.pane-surface').focus();
  await page.keyboard.press('ArrowUp');
  await expect(place(page, 'axial')).not.toHaveText(before.axial);
  const moved = await place(page, 'axial').innerText();
  const model = page.locator('.pane.model .pane-surface');
  const box = (await model.boundingBox())!;
  await model.click({ position: { x: box.width * 0.5, y: box.height * 0.6 } });
  await expect(page.locator('.picked')).toContainText('Tetrahedron');
  await expect(page.locator('.picked')).toContainText('Target edge');
  await expect(place(page, 'axial')).not.toHaveText(moved);
});

test('the sizing field lies over the slices with its scale, and the mesh is cut by them', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  await page.getByRole('button', { name: 'Slices', exact: true }).click();
  const withEdges = await sampled(page, 'axial');
  await page.getByRole('button', { name: 'Edges', exact: true }).click();
  const labels = await sampled(page, 'axial');
  expect(labels).not.toEqual(withEdges);
  await page.getByRole('group', { name: 'Slices show' }).getByRole('button', { name: 'Edge length' }).click();
  await expect(page.locator('.scale-strip')).toContainText('mm');
  expect(await sampled(page, 'axial')).not.toEqual(labels);
});

test('a cut leaves tetrahedra whole or goes through them; labels come apart; every measure is a colour', async ({
  page,
}) => {
  await openAndRun(page, smallHeart);
  const look = async () => sampled(page, 'model');
  const closed = await look();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  const whole = await look();
  expect(whole).not.toEqual(closed);
  await page.getByRole('button', { name: 'Flat', exact: true }).click();
  const flat = await look();
  expect(flat).not.toEqual(whole);
  await page.getByLabel('Place of the cut').fill('0.4');
  expect(await look()).not.toEqual(flat);
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  expect(await look()).toEqual(closed);
  await page.getByLabel('Pull the labels apart').fill('1');
  expect(await look()).not.toEqual(closed);
  await page.getByLabel('Pull the labels apart').fill('0');
  for (const [value, title] of [
    ['edge_mm', 'Mean edge length mm'],
    ['target_mm', 'Target edge length mm'],
    ['size_log2', 'Edge length over target'],
    ['min_dihedral_deg', 'Smallest dihedral angle °'],
    ['max_dihedral_deg', 'Largest dihedral angle °'],
    ['radius_ratio', 'Radius ratio'],
    ['mean_ratio', 'Mean ratio'],
    ['aspect_ratio', 'Aspect ratio'],
    ['distance_mm', 'Distance to the label surface mm'],
    ['distance_voxels', 'Distance to the label surface voxels'],
  ]) {
    await page.getByLabel('Colour by').selectOption(value);
    await expect(page.locator('.legend')).toContainText(title);
  }
  await page.getByLabel('Colour by').selectOption('label');
  expect(await look()).toEqual(closed);
  await stage(page, 'remesh').click();
  await expect(page.getByLabel('Colour by')).toHaveValue('label');
});

test('keys turn the view over, and a picture of it is saved', async ({ page }) => {
  await openAndRun(page, smallHeart);
  await page.locator('.pane.model .pane-surface').focus();
  await page.keyboard.press('2');
  await expect(slice(page, 'axial')).toBeVisible();
  await page.keyboard.press('1');
  await expect(slice(page, 'axial')).toBeHidden();
  await page.keyboard.press('[');
  await expect(stage(page, 'optimise')).toHaveAttribute('aria-current', 'step');
  await page.keyboard.press(']');
  await page.keyboard.press('c');
  await expect(page.getByLabel('Place of the cut')).toBeVisible();
  await page.getByLabel('Colour by').selectOption('radius_ratio');
  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save a picture of the view' }).click();
  const download = await downloading;
  expect(download.suggestedFilename()).toBe('biventricle.png');
  const png = await readFile(await download.path());
  const sides = await page.locator('.view-host').evaluate((host) => [host.clientWidth, host.clientHeight]);
  expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual(sides.map((side) => 2 * side));
  expect(png.length).toBeGreaterThan(50_000);
});

test('a uniform of both shaders of a program has one precision, without which WebKit links none', async ({
  page,
}) => {
  await page.addInitScript(() => {
    const programs: string[][] = [];
    const { linkProgram } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.linkProgram = function (program) {
      programs.push((this.getAttachedShaders(program) ?? []).map((one) => this.getShaderSource(one) ?? ''));
      linkProgram.call(this, program);
    };
    Object.assign(globalThis, { programs });
  });
  await openAndRun(page, smallHeart);
  const programs = await page.evaluate(() => (globalThis as unknown as { programs: string[][] }).programs);
  expect(programs.length).toBeGreaterThan(5);
  /** Precision of each uniform sampler, float and vector, where it is said or the default of its shader. */
  const precisions = (source: string) => {
    const code = source.replace(/\/\/.*|\/\*[\s\S]*?\*\//g, '');
    const said = Object.fromEntries(
      [...code.matchAll(/precision (\w+) (\w+)/g)].map(([, how, type]) => [type, how]),
    );
    const declared = code.matchAll(/uniform\s+(?:(lowp|mediump|highp)\s+)?(\w+)\s+([^;]+);/g);
    return new Map(
      [...declared].flatMap(([, how, type, names]) =>
        names.split(',').map((name) => {
          const base = /^(vec|mat)/.test(type) ? 'float' : type;
          return [name.trim(), how ?? said[base] ?? 'default'] as const;
        }),
      ),
    );
  };
  const mixed = programs.flatMap(([one, other]) => {
    const theirs = precisions(other);
    return [...precisions(one)].filter(([name, how]) => theirs.has(name) && theirs.get(name) !== how);
  });
  expect(mixed).toEqual([]);
});
