/** Files that the user opens or drops: volumes, cases, zips, studies, what sizes come from, and values on the mesh. */
import { signal } from '@preact/signals';
import type { Labels, SideKind, VolumeFile, VolumeSummary } from '../../engine/contract';
import { parseCase } from '../../link/codec';
import { offerCase, takeVolume } from './open_case';
import { engine, takeTurn, tellError } from '../run/engine';
import { awaitedFile, fileRead, volume } from './input';
import { lessonAsked } from './keep/lesson_asked';
import { announcement, tell } from '../notices';
import { findStudy, openStudy } from '../study/study';
import { activity, endStages } from '../run/stages';
import { previewSoon } from '../run/run_stages';
import { recipe } from './recipe';
import { awaitedSides } from './side_files';
import { openSideFile } from './size_files';

/** Label descriptions of ITK-SNAP, colour tables of 3D Slicer and FreeSurfer. */
const legendSuffix = /\.(txt|label|ctbl|lut)$/i;

const headerSuffix =
  /\.(nii|nii\.gz|nrrd|nhdr|mha|mhd|mgh|mgz|hdr|elem|ele|vtu|vtk|msh|mesh|inp|bdf|nas|feb|xdmf)$/i;

/** DICOM files say so after 128 bytes of anything. */
async function isDicom(file: File): Promise<boolean> {
  return (await file.slice(128, 132).text()) === 'DICM';
}

/** Of openCARP, at the points of a mesh. */
const areValues = (files: readonly File[]) =>
  files.length > 0 && files.every(({ name }) => /\.(dat|igb)$/i.test(name));

async function openValues(files: readonly File[]): Promise<void> {
  const values = await import('../run/values');
  await values.openValues(files);
}

/** Names and colours of labels. */
async function openLegend(file: File): Promise<void> {
  const { openLegendFile } = await import('./legend/legend_file');
  await openLegendFile(file);
}

/** Files that were dropped on an open case: what they are for is for the user to say. */
export const droppedFiles = signal<File[] | null>(null);

/** A file that could not be read, where the engine names what the user may say of it. */
export const unread = signal<{ file: VolumeFile; message: string } | null>(null);

/** A file whose values look like those of an image, not like labels; without a summary it could not be read. */
export const imageAsked = signal<{ file: VolumeFile; summary: VolumeSummary | null; message: string } | null>(
  null,
);
const imageWords = 'an image, not labels?';

/** Whoever comes second is read second, and does not end the first. */
let reading: Promise<void> = Promise.resolve();

/** The file that others belong to: the first with a header, which may name them. */
function mainFirst(files: readonly File[]): File[] {
  const main = files.find(({ name }) => headerSuffix.test(name)) ?? files[0];
  return [main, ...files.filter((file) => file !== main)];
}

function tellLeftOut(opened: string, files: readonly File[]): void {
  if (files.length === 0) return;
  const names = files.map(({ name }) => name).join(', ');
  tell('news', 'Not everything was opened', `${opened} is opened; left out: ${names}.`);
}

/** Reads a file with those that its header may name; other volumes are left out, and that is said. */
async function volumeFileOf([main, ...others]: readonly File[]): Promise<VolumeFile> {
  tellLeftOut(
    main.name,
    others.filter(({ name }) => headerSuffix.test(name)),
  );
  if (await isDicom(main)) {
    const { readDicomSegmentation } = await import('../../dicom/read_segmentation');
    const bytes = await readDicomSegmentation(main.name, new Uint8Array(await main.arrayBuffer()));
    return { name: main.name.replace(/(\.dcm)?$/i, '.seg.nrrd'), bytes, siblings: {} };
  }
  const siblings: VolumeFile['siblings'] = {};
  for (const file of others)
    if (!headerSuffix.test(file.name)) siblings[file.name] = new Uint8Array(await file.arrayBuffer());
  return { name: main.name, bytes: new Uint8Array(await main.arrayBuffer()), siblings };
}

/** What is dropped on the page: asked about where a case is open, unless the case waits for it. */
export async function dropFiles(files: File[]): Promise<void> {
  if (files.length === 0) return;
  if (await openAwaited(files)) return;
  if (areValues(files)) return openValues(files);
  if (volume.value && files.length === 1 && legendSuffix.test(files[0].name)) return openLegend(files[0]);
  const opens = volume.value === null || files.some((file) => /\.(json|zip)$/i.test(file.name));
  if (opens || (await findStudy(files))) return openFiles(files);
  droppedFiles.value = files;
}

/** Files that the case asks for by these names, its volume last; false where there are none. */
async function openAwaited(files: readonly File[]): Promise<boolean> {
  const asked: { name: string; kind: SideKind | null }[] = [...awaitedSides.value];
  if (awaitedFile.value) asked.push({ name: awaitedFile.value.name, kind: null });
  const found = asked.flatMap(({ name, kind }) => {
    const file = files.find((one) => one.name === name);
    return file ? [{ file, kind }] : [];
  });
  if (found.length === 0) return false;
  const rest = files.filter((file) => !found.some((one) => one.file === file));
  const raw = rest.filter(({ name }) => !headerSuffix.test(name));
  tellLeftOut(
    found.map(({ file }) => file.name).join(', '),
    rest.filter((file) => !raw.includes(file)),
  );
  for (const { file, kind } of found)
    await (kind ? openSide(kind, [file, ...raw]) : openVolume([file, ...raw]));
  return true;
}

export function openSizeFiles(kind: SideKind, files: readonly File[]): Promise<void> {
  return openSide(kind, mainFirst(files));
}

async function openSide(kind: SideKind, files: readonly File[]): Promise<void> {
  reading = reading.then(() => openSideFile(kind, () => volumeFileOf(files)));
  await reading;
  previewSoon();
}

/** A file to be meshed, with the raw file that its header may name. A case file opens like a link. */
export async function openFiles(files: File[]): Promise<void> {
  if (areValues(files)) return openValues(files);
  const study = await findStudy(files);
  if (study) {
    tellLeftOut(study.table.name, study.rest);
    return openStudy(study);
  }
  const caseFile = files.find((file) => /\.json$/i.test(file.name));
  const zip = files.find((file) => /\.zip$/i.test(file.name));
  const whole = caseFile ?? zip;
  if (whole) {
    tellLeftOut(
      whole.name,
      files.filter((file) => file !== whole),
    );
    await (whole === caseFile ? openCase(whole) : (await import('./zip/open_zip')).openZip(whole));
  } else if (files.length > 0) await openVolume(mainFirst(files));
}

function openVolume(files: readonly File[]): Promise<void> {
  return (reading = readVolume(files));
}

async function readVolume(files: readonly File[]): Promise<void> {
  const newest = takeTurn();
  fileRead.value = files[0].name;
  activity.value = 'opening';
  announcement.value = `Reading ${files[0].name}`;
  let file: VolumeFile | undefined;
  try {
    file = await volumeFileOf(files);
    if (!newest()) return;
    endStages();
    if (engine.busy) await engine.cancel();
    let labels: Labels | undefined;
    const source = awaitedFile.value ? recipe.value?.source : {};
    const summary = await engine.openVolume(file, source, (read) => (labels = read));
    if (!newest()) return;
    const message = awaitedFile.value
      ? undefined
      : summary.warnings.find((text) => text.includes(imageWords));
    if (message) imageAsked.value = { file, summary, message };
    else takeVolume(summary, files[0].name, {}, labels);
  } catch (error) {
    const { message } = error as Error;
    const mayAsk = file && !awaitedFile.value;
    if (file && mayAsk && message.includes(imageWords)) imageAsked.value = { file, summary: null, message };
    else if (file && mayAsk && /\bsource\.(unit|background|frame)\b/.test(message))
      unread.value = { file, message };
    else tellError(error);
  } finally {
    if (newest() && activity.value === 'opening') activity.value = 'idle';
  }
}

async function openCase(file: File): Promise<void> {
  try {
    const text = await file.text();
    // What a lesson may hold is checked by what reads lessons.
    if (/\.lesson\.json$/i.test(file.name)) return void (lessonAsked.value = { from: 'file', text });
    const value = parseCase(text);
    // A report holds its recipe, and is the promise of its mesh.
    const inner = value.recipe as Record<string, unknown> | undefined;
    await offerCase(
      inner && typeof value.digest === 'string'
        ? { ...inner, expected: { engine: value.engine, digest: value.digest, tets: value.tets } }
        : value,
    );
  } catch (error) {
    tellError(error);
  }
}
