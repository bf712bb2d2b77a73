/** What leaves the page: files of the mesh, the report, the case, a link. */
import type { ElementOrder, Expected, ExportFormat, Recipe, Space, Traces } from '../../engine/contract';
import { encodeFragment } from '../../link/codec';
import { tracesCsv } from '../run/beat/loops';
import { engine, takeTurn, tellError } from '../run/engine';
import { forecastUnderWay } from '../run/forecast';
import { caseName, recipe } from './recipe';
import { announcement } from '../notices';
import { fullReport, meshedRecipe, promiseOf } from '../run/report';
import { activity } from '../run/stages';
import { paintedName } from './painting';
import { review } from './review';
import { viewNow } from './shared_view';
import { heldSides } from './side_files';
import { command, sceneMounted } from '../view';
import { packZip } from './zip/zip';

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

export function exportMesh(format: ExportFormat, space: Space, order: ElementOrder = 1): Promise<void> {
  return writing(format, async (meshed, name) => {
    const files = await engine.exportMesh(JSON.stringify(meshed), meshed.source, format, space, name, {
      order,
    });
    // Browsers ask about each of many files.
    const archive = { label_stl: 'stl', svmultiphysics: 'svmultiphysics' }[format as string];
    if (archive) {
      const entries = files.map(({ suffix, bytes }) => [`${name}${suffix}`, bytes] as const);
      const zip = await packZip(Object.fromEntries(entries));
      download(`${name}.${archive}.zip`, new Blob([zip], { type: 'application/zip' }));
      return `${files.length} files in one zip written`;
    }
    for (const file of files) download(`${name}${file.suffix}`, new Blob([file.bytes]));
    return `${files.length === 1 ? 'File' : `${files.length} files`} written`;
  });
}

/**
 * Mesh, report and case in one file, with the masks and images that the case is made from, described as a research
 * object (RO-Crate).
 */
export function exportZip(format: ExportFormat, space: Space, order: ElementOrder = 1): Promise<void> {
  return writing('zip', async (meshed, name, newest) => {
    const { minimal, url } = await shareCase();
    const { htmlFile } = await import('../../report/review_page');
    const page = htmlFile(name, await review());
    if (!newest()) return '';
    const mesh = await engine.exportMesh(JSON.stringify(meshed), meshed.source, format, space, name, {
      order,
    });
    const text = (value: unknown) => new TextEncoder().encode(JSON.stringify(value, null, 2));
    const found = fullReport.value;
    if (!found) return '';
    const { crateFileName, mediaTypeOf, roCrate } = await import('../../report/ro_crate');
    const file = (path: string, description: string, bytes: Uint8Array<ArrayBuffer>, isInput = false) => ({
      path,
      description,
      format: mediaTypeOf(path),
      bytes,
      isInput,
    });
    const sides = heldSides().flatMap(({ file: { name, bytes, siblings } }) =>
      Object.entries({ ...siblings, [name]: bytes }),
    );
    const files = [
      ...mesh.map(({ suffix, bytes }) => file(`${name}${suffix}`, 'The mesh', bytes)),
      ...sides.map(([path, bytes]) => file(path, 'A mask or an image of sizes', bytes, true)),
      file(`${name}.case.json`, 'The case: recipe, promised digests', text(minimal), true),
      file(`${name}.report.json`, 'What was measured, and how it was made', text(found)),
      file(`${name}.report.html`, 'The evidence as a page', new TextEncoder().encode(page)),
    ];
    const crate = await roCrate(found, files, { title: name, link: url, at: new Date() });
    const zip = await packZip({
      ...Object.fromEntries(files.map(({ path, bytes }) => [path, bytes])),
      [crateFileName]: text(crate),
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
  if (!fullReport.value) return;
  download(
    `${caseName()}.report.json`,
    new Blob([JSON.stringify(fullReport.value, null, 2)], { type: 'application/json' }),
  );
}

/** What was recorded of a heart that beats, for a spreadsheet. */
export function downloadHeartbeat(traces: Traces): void {
  download(`${caseName()}.heartbeat.csv`, new Blob([tracesCsv(traces)], { type: 'text/csv' }));
}

export function downloadCase(minimal: Record<string, unknown>): void {
  download(
    `${caseName()}.case.json`,
    new Blob([JSON.stringify(minimal, null, 2)], { type: 'application/json' }),
  );
}

export function downloadLesson(title: string, text: string): void {
  const name =
    title
      .trim()
      .toLowerCase()
      .replace(/[^\p{L}\p{N}]+/gu, '-') || 'lesson';
  download(`${name}.lesson.json`, new Blob([text], { type: 'application/json' }));
}

/** What is painted here, for whoever opens a link that asks for it. */
export function downloadPainted(): void {
  const file = engine.files.side('mask', paintedName);
  if (file) download(file.name, new Blob([file.bytes]));
}

export function download(name: string, blob: Blob): void {
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
