/** What leaves the page: files of the mesh, the report, the case, a link. */
import type { Expected, ExportFormat, Recipe, Space } from '../../engine/contract';
import { encodeFragment } from '../../link/codec';
import type { ReportPicture } from '../../report/report_page';
import { engine, takeTurn, tellError } from '../run/engine';
import { forecastUnderWay } from '../run/forecast';
import { caseName, recipe } from './recipe';
import { announcement } from '../notices';
import { meshedRecipe, promiseOf, report } from '../run/report';
import { activity } from '../run/stages';
import { paintedName } from './painting';
import { viewNow } from './shared_view';
import { heldSides } from './side_files';
import { chooseLayout, command, layout, sceneMounted, type Layout } from '../view';
import { packZip } from './zip/zip';
import { nameOf } from './legend/legend';

/** Runs what writes files, and says so. */
async function writing(
  what: string,
  write: (meshed: Recipe, name: string, newest: () => boolean) => Promise<string>,
): Promise<void> {
  const meshed = meshedRecipe.value;
  if (!meshed) return;
  const newest = takeTurn();
  activity.value = 'export';
  announcement.value = `Writing ${what}`;
  // What waits in the engine's queue could not be cancelled.
  await forecastUnderWay()?.done;
  if (!newest()) return;
  try {
    const written = await write(meshed, caseName(), newest);
    if (newest()) announcement.value = written;
  } catch (error) {
    if (newest()) tellError(error);
  } finally {
    if (newest()) activity.value = 'idle';
  }
}

export function exportMesh(format: ExportFormat, space: Space): Promise<void> {
  return writing(format, async (meshed, name) => {
    const files = await engine.exportMesh(JSON.stringify(meshed), meshed.source, format, space, name);
    // Browsers ask about each of many files.
    if (format === 'label_stl') {
      const entries = files.map(({ suffix, bytes }) => [`${name}${suffix}`, bytes] as const);
      const zip = await packZip(Object.fromEntries(entries));
      download(`${name}.stl.zip`, new Blob([zip], { type: 'application/zip' }));
      return `${files.length} files in one zip written`;
    }
    for (const file of files) download(`${name}${file.suffix}`, new Blob([file.bytes]));
    return `${files.length === 1 ? 'File' : `${files.length} files`} written`;
  });
}

/** Mesh, report and case in one file, with the masks and images that the case is made from. */
export function exportZip(format: ExportFormat, space: Space): Promise<void> {
  return writing('zip', async (meshed, name, newest) => {
    const { minimal } = await shareCase();
    const page = await reportBlob();
    if (!newest()) return '';
    const mesh = await engine.exportMesh(JSON.stringify(meshed), meshed.source, format, space, name);
    const text = (value: unknown) => new TextEncoder().encode(JSON.stringify(value, null, 2));
    const zip = await packZip({
      ...Object.fromEntries(mesh.map(({ suffix, bytes }) => [`${name}${suffix}`, bytes])),
      ...Object.assign({}, ...heldSides().map(({ file }) => ({ ...file.siblings, [file.name]: file.bytes }))),
      [`${name}.case.json`]: text(minimal),
      [`${name}.report.json`]: text(report.value),
      [`${name}.report.html`]: new Uint8Array(await page.arrayBuffer()),
    });
    if (!newest()) return '';
    download(`${name}.zip`, new Blob([zip], { type: 'application/zip' }));
    return 'Zip written';
  });
}

/** The view as it stands, as a picture. */
export function viewPicture(): Promise<Blob> {
  if (!sceneMounted.value) return Promise.reject(new Error('There is no 3-D view to take a picture of.'));
  return new Promise((made) => (command.value = { kind: 'picture', take: made }));
}

export async function downloadPicture(): Promise<void> {
  try {
    download(`${caseName()}.png`, await viewPicture());
  } catch (error) {
    tellError(error);
  }
}

export function downloadReport(): void {
  if (!report.value) return;
  download(
    `${caseName()}.report.json`,
    new Blob([JSON.stringify(report.value, null, 2)], { type: 'application/json' }),
  );
}

function dataUrl(blob: Blob): Promise<string> {
  return new Promise((read, failed) => {
    const reader = new FileReader();
    reader.onload = () => read(String(reader.result));
    reader.onerror = () => failed(reader.error);
    reader.readAsDataURL(blob);
  });
}

/** The view in each of these layouts, then as it was; none where there is no view. */
async function picturesOf(layouts: readonly [Layout, string][]): Promise<ReportPicture[]> {
  if (!sceneMounted.value) return [];
  const before = layout.value;
  const pictures: ReportPicture[] = [];
  try {
    for (const [next, title] of layouts) {
      chooseLayout(next);
      await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
      pictures.push({ title, source: await dataUrl(await viewPicture()) });
    }
  } finally {
    chooseLayout(before);
  }
  return pictures;
}

/** The report as a page with pictures, for whoever has no voxtet. */
async function reportBlob(): Promise<Blob> {
  const found = report.value;
  if (!found) throw new Error('There is no report yet.');
  const [{ reportPage }, pictures, { url: link }] = await Promise.all([
    import('../../report/report_page'),
    picturesOf([
      ['model', 'The mesh'],
      ['slices', 'Slices of the image with the mesh'],
    ]),
    shareCase(),
  ]);
  const page = reportPage(found, { title: caseName(), link, pictures, nameOf });
  return new Blob([page], { type: 'text/html' });
}

export async function downloadReportPage(): Promise<void> {
  try {
    download(`${caseName()}.report.html`, await reportBlob());
    announcement.value = 'Report written';
  } catch (error) {
    tellError(error);
  }
}

export function downloadCase(minimal: Record<string, unknown>): void {
  download(
    `${caseName()}.case.json`,
    new Blob([JSON.stringify(minimal, null, 2)], { type: 'application/json' }),
  );
}

/** What is painted here, for whoever opens a link that asks for it. */
export function downloadPainted(): void {
  const file = engine.files.side('mask', paintedName);
  if (file) download(file.name, new Blob([file.bytes]));
}

function download(name: string, blob: Blob): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 30_000);
}

export interface SharedCase {
  url: string;
  minimal: Record<string, unknown>;
  /** What the link promises: the mesh that is shown, and what was simulated on it. */
  promises: Expected | undefined;
}

/**
 * A link of this case; with digests where the mesh that is shown is the recipe's; with the label volume itself and with
 * the view as it stands where those are asked for.
 */
export async function shareCase({ withVolume = false, withView = false } = {}): Promise<SharedCase> {
  const current = recipe.value;
  if (!current) throw new Error('There is no case to share yet.');
  const { minimal } = await engine.checkRecipe(current);
  if (withVolume && current.source.file) {
    const { source, legend } = (await engine.inlineCase(JSON.stringify(current), current.source)).minimal;
    Object.assign(minimal, { source, ...(legend ? { legend } : {}) });
  }
  const expected = promiseOf(current);
  if (expected) minimal.expected = expected;
  if (withView) minimal.view = await viewNow();
  const url = new URL(location.href);
  url.search = '';
  url.hash = await encodeFragment(minimal);
  return { url: url.href, minimal, promises: expected };
}
