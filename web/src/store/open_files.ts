/** Files that the user opens or drops: volumes, cases, zips, and what sizes come from. */
import { signal } from '@preact/signals';
import type { FileSource, SideKind, VolumeFile } from '../engine/contract';
import { parseCase } from '../link/codec';
import { offerCase, offered, takeVolume } from './actions';
import { engine, takeTurn, tellError } from './engine';
import { volume } from './input';
import { activity, announcement } from './run';
import { previewSoon } from './runs';
import { awaitedSides, type SideFile } from './side_files';
import { openSideFile } from './size_files';
import { unpackZip } from './zip';

const headerSuffix = /\.(nii|nii\.gz|nrrd|nhdr|mha|mhd|hdr)$/i;

/** DICOM files say so after 128 bytes of anything. */
async function isDicom(file: File): Promise<boolean> {
  return (await file.slice(128, 132).text()) === 'DICM';
}

/** Files that were dropped on an open case: what they are for is for the user to say. */
export const droppedFiles = signal<File[] | null>(null);

const mainOf = (files: readonly File[]) => files.find((file) => headerSuffix.test(file.name)) ?? files[0];

async function volumeFileOf(files: readonly File[]): Promise<VolumeFile> {
  const main = mainOf(files);
  if (await isDicom(main)) {
    const { readDicomSegmentation } = await import('../dicom/read_segmentation');
    const bytes = await readDicomSegmentation(main.name, new Uint8Array(await main.arrayBuffer()));
    return { name: main.name.replace(/(\.dcm)?$/i, '.seg.nrrd'), bytes, siblings: {} };
  }
  const siblings: VolumeFile['siblings'] = {};
  for (const file of files) if (file !== main) siblings[file.name] = new Uint8Array(await file.arrayBuffer());
  return { name: main.name, bytes: new Uint8Array(await main.arrayBuffer()), siblings };
}

/** What is dropped on the page: asked about where a case is open, unless the case waits for it. */
export async function dropFiles(files: File[]): Promise<void> {
  const awaited = awaitedSides.value.find(({ name }) => files.some((file) => file.name === name));
  if (awaited) return openSizeFiles(awaited.kind, files);
  const opens = volume.value === null || files.some((file) => /\.(json|zip)$/i.test(file.name));
  if (opens) return openFiles(files);
  droppedFiles.value = files;
}

export async function openSizeFiles(kind: SideKind, files: File[]): Promise<void> {
  try {
    await openSideFile(kind, await volumeFileOf(files));
    previewSoon();
  } catch (error) {
    tellError(error);
  }
}

/** A zip that was exported here: its case, with the masks and images in it. */
async function openZip(file: File): Promise<void> {
  try {
    const entries = await unpackZip(new Uint8Array(await file.arrayBuffer()));
    const name = Object.keys(entries).find((one) => one.endsWith('.case.json'));
    if (!name) throw new Error(`${file.name} holds no case: no file in it ends in .case.json.`);
    const value = parseCase(new TextDecoder().decode(entries[name]));
    await offerCase(value);
    const { masks, images } = offered.value?.recipe.sizing ?? { masks: [], images: [] };
    const sidesOf = (kind: SideKind, files: FileSource[]) =>
      files.flatMap(({ name, sha256 }): SideFile[] =>
        entries[name] ? [{ kind, file: { name, bytes: entries[name], siblings: {} }, digest: sha256 }] : [],
      );
    // The engine holds their content against the digests of the case.
    const sides = [...sidesOf('mask', masks), ...sidesOf('image', images)];
    if (offered.value) offered.value = { ...offered.value, sides };
  } catch (error) {
    tellError(error);
  }
}

/** A file to be meshed, with the raw file that its header may name. A case file opens like a link. */
export async function openFiles(files: File[]): Promise<void> {
  const caseFile = files.find((file) => /\.json$/i.test(file.name));
  if (caseFile) return openCaseText(await caseFile.text());
  const zip = files.find((file) => /\.zip$/i.test(file.name));
  if (zip) return openZip(zip);
  if (files.length === 0) return;
  const newest = takeTurn();
  activity.value = 'opening';
  announcement.value = `Reading ${files.map(({ name }) => name).join(', ')}`;
  try {
    const file = await volumeFileOf(files);
    if (engine.busy) await engine.cancel();
    const summary = await engine.openVolume(file);
    if (newest()) takeVolume(summary, mainOf(files).name);
  } catch (error) {
    tellError(error);
  } finally {
    if (newest() && activity.value === 'opening') activity.value = 'idle';
  }
}

async function openCaseText(text: string): Promise<void> {
  try {
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
