/** Cases of other versions, labels that are transferred, errors that have a place. */
import { expect, idle, link, meshed, openAndRun, smallHeart, stage, test, tetCount } from './support';

test('a saved case of another version is taken up without the fields that are gone, which are named', async ({
  page,
}) => {
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  await page.getByLabel('Edge length', { exact: true }).fill('4.5');
  await page.waitForTimeout(1500);
  await page.evaluate(
    () =>
      new Promise<void>((done, failed) => {
        const request = indexedDB.open('voxtet', 1);
        request.onerror = () => failed(request.error);
        request.onsuccess = () => {
          const store = request.result.transaction('case', 'readwrite').objectStore('case');
          const reading = store.get('recipe');
          reading.onsuccess = () => {
            const kept = reading.result;
            delete kept.recipe.transfer;
            kept.recipe.merge = true;
            kept.recipe.remesh.smoothing_voxels = 0.7;
            const writing = store.put(kept, 'recipe');
            writing.onsuccess = () => done();
          };
        };
      }),
  );
  // Once only: a page that is left while it makes its preview asks first.
  await page.goto('./');
  await expect(page.getByRole('alert')).toContainText('merge, remesh.smoothing_voxels');
  await expect(page.getByLabel('Edge length', { exact: true })).toHaveValue('4.5');
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
});

test('a label is transferred instead of meshed, coloured by its share and compared with its voxels', async ({
  page,
}) => {
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await idle(page);
  for (const name of ['scar core', 'border zone'])
    await page.getByLabel(`Region of ${name}`).selectOption({ label: '1 with LV myocardium' });
  await page.getByText('Label transfer').click();
  await page.getByLabel('Transfer scar core').check();
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(page.getByTestId('transfer').locator('tbody tr')).toHaveCount(1);
  await page.getByLabel('Colour by').selectOption({ label: 'Share of scar core' });
  await expect(page.locator('.legend')).toContainText('Share of scar core');
  await page.getByLabel('Colour by').selectOption({ label: 'Majority label' });
  await expect(page.locator('.legend')).toHaveCount(0);
});

test('an error of the mesher shows its triangles on the adapted surface', async ({ page }) => {
  await page.route('**/voxtet_engine.mjs', async (route) => {
    const response = await route.fetch();
    const failing = `const createFailing = async (options) => {
        const engine = await createVoxtet(options);
        if (!engine.Session) return engine; // on a thread of the engine
        const { begin, advance } = engine.Session.prototype;
        let stage = '';
        engine.Session.prototype.begin = function (asked) {
          stage = asked;
          return begin.call(this, asked);
        };
        engine.Session.prototype.advance = function (budget, progress) {
          if (stage !== 'optimise') return advance.call(this, budget, progress);
          const points = this.array('remesh', 'points');
          const where = { points: [Array.from(points.slice(0, 3))], elements: [0, 1], stage: 'remesh', on: 'triangles' };
          const message = 'the surface intersects itself: 2 triangles';
          return JSON.stringify({ ok: false, error: { code: 'meshing', stage, message, where } });
        };
        return engine;
      };
      export default createFailing;`;
    const body = (await response.text()).replace(/export default createVoxtet;?/, failing);
    await route.fulfill({ response, body });
  });
  await page.goto(link(smallHeart));
  await page.getByRole('button', { name: 'Open and run' }).click();
  await expect(page.getByRole('alert')).toContainText('the surface intersects itself');
  await idle(page);
  await expect(stage(page, 'optimise')).toHaveAttribute('data-state', 'failed');
  await expect(stage(page, 'remesh')).toHaveAttribute('aria-current', 'step');
  await stage(page, 'surface').click();
  await page.getByRole('button', { name: 'Show where' }).click();
  await expect(stage(page, 'remesh')).toHaveAttribute('aria-current', 'step');
});

test('a plane gives the heart a flat base, which is said', async ({ page }) => {
  await openAndRun(page, smallHeart);
  const before = await tetCount(page);
  const cuts = page.locator('section', { has: page.getByRole('heading', { name: 'Flat cuts' }) });
  await cuts.getByRole('button', { name: 'Plane' }).click();
  await expect(cuts.getByLabel('Name of the flat surface')).toHaveValue('base');
  await cuts.getByLabel('Cut away A').fill('0.2');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await meshed(page);
  await expect(page.getByText(/the plane base cuts away [\d]+ voxels of label 1/)).toBeAttached();
  expect(await tetCount(page)).toBeLessThan(0.9 * before);
});
