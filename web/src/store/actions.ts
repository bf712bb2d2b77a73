/** What the user can do: each action moves the store, and asks the engine where that needs it. */
import { signal } from '@preact/signals';
import type { EngineClient } from '../engine/client';
import {
  EngineError,
  type Expected,
  type PhantomParams,
  type Recipe,
  type SideKind,
  type VolumeFile,
  type VolumeSummary,
} from '../engine/contract';
import { decodeFragment, parseCase } from '../link/codec';
import { autosave, savedCase, type SavedCase } from './autosave';
import { engine, takeTurn, tellError, useEngine } from './engine';
import { estimateTets } from './estimate';
import { fitRecipe } from './fit_recipe';
import type { Example } from './gallery';
import { awaitedFile, volume } from './input';
import { amendRecipe, editRecipe, recipe, redo, startRecipe, undo } from './recipe';
import { activity, announcement, defaults, expectation, forgetResults, schema, tell } from './run';
import { preview, previewSoon, runAll } from './runs';
import { awaitedSides, forgetSides, holdSide, type SideFile } from './side_files';
import { openSideFile } from './size_files';
import { forgetPainting, restorePainting, strokesDone } from './painting';
import { ownColours, resetView } from './view';

/** A case that a link or a file offers, checked and waiting for the user's word. */
export interface OfferedCase {
  recipe: Recipe;
  expected: Expected | null;
  origin: 'link' | 'interrupted';
  colours: SavedCase['colours'];
  /** Masks and images of sizes that are at hand. */
  sides: SideFile[];
}

export const offered = signal<OfferedCase | null>(null);

export async function startEngine(client: EngineClient): Promise<void> {
  useEngine(client);
  try {
    const info = await engine.ready;
    schema.value = info.schema;
    defaults.value = withoutPromise(info.defaults);
    startRecipe(defaults.value);
    activity.value = 'idle';
  } catch (error) {
    activity.value = 'idle';
    tellError(error);
  }
}

export async function openExample({ recipe: value }: Example): Promise<void> {
  await offerCase(value);
  acceptOffer(false);
}

export async function openPhantom(params: Partial<PhantomParams>): Promise<void> {
  await offerCase({ source: { phantom: params as Record<string, unknown> } });
  acceptOffer(false);
}

/** Changes the generated body and keeps the rest of the recipe. */
export function editPhantom(label: string, change: Partial<PhantomParams>): void {
  editRecipe(
    label,
    (draft) => draft.source.phantom && Object.assign(draft.source.phantom, change),
    `phantom ${label}`,
  );
}

const headerSuffix = /\.(nii|nii\.gz|nrrd|nhdr|mha|mhd|hdr)$/i;

/** Files that were dropped on an open case: what they are for is for the user to say. */
export const droppedFiles = signal<File[] | null>(null);

async function volumeFileOf(files: readonly File[]): Promise<VolumeFile | null> {
  const main = files.find((file) => headerSuffix.test(file.name)) ?? files[0];
  if (!main) return null;
  const siblings: VolumeFile['siblings'] = {};
  for (const file of files) if (file !== main) siblings[file.name] = new Uint8Array(await file.arrayBuffer());
  return { name: main.name, bytes: new Uint8Array(await main.arrayBuffer()), siblings };
}

/** What is dropped on the page: asked about where a case is open, unless the case waits for it. */
export async function dropFiles(files: File[]): Promise<void> {
  const awaited = awaitedSides.value.find(({ name }) => files.some((file) => file.name === name));
  if (awaited) return openSizeFiles(awaited.kind, files);
  const opens = volume.value === null || files.some((file) => /\.json$/i.test(file.name));
  if (opens) return openFiles(files);
  droppedFiles.value = files;
}

export async function openSizeFiles(kind: SideKind, files: File[]): Promise<void> {
  const file = await volumeFileOf(files);
  if (!file) return;
  await openSideFile(kind, file);
  previewSoon();
}

/** A file to be meshed, with the raw file that its header may name. A case file opens like a link. */
export async function openFiles(files: File[]): Promise<void> {
  const caseFile = files.find((file) => /\.json$/i.test(file.name));
  if (caseFile) return openCaseText(await caseFile.text());
  const newest = takeTurn();
  activity.value = 'opening';
  announcement.value = `Reading ${files.map(({ name }) => name).join(', ')}`;
  try {
    const file = await volumeFileOf(files);
    if (!file) return;
    if (engine.busy) await engine.cancel();
    const summary = await engine.openVolume(file);
    if (newest()) takeVolume(summary, file.name);
  } catch (error) {
    tellError(error);
  } finally {
    if (newest() && activity.value === 'opening') activity.value = 'idle';
  }
}

function takeVolume(summary: VolumeSummary, fileName: string): void {
  const awaited = awaitedFile.value;
  if (awaited && awaited.sha256 && awaited.sha256 !== summary.digest) {
    tell(
      'error',
      'This is not the expected volume',
      `${fileName} holds other voxels than the case was made from (digest ${summary.digest.slice(0, 12)}…, ` +
        `expected ${awaited.sha256.slice(0, 12)}…). The case is kept; drop ${awaited.name} to go on.`,
    );
    return;
  }
  const source = { file: { name: fileName, sha256: summary.digest } };
  if (awaited) {
    awaitedFile.value = null;
    amendRecipe((draft) => void (draft.source = source));
  } else if (defaults.value) {
    const edge = startingEdge(summary);
    const fresh = structuredClone(defaults.value);
    leaveCase();
    startRecipe({ ...fresh, source, sizing: { ...fresh.sizing, edge_mm: edge } });
    expectation.value = null;
  }
  volume.value = summary;
  forgetResults();
  resetView();
  void preview(true);
}

/** Forgets what belongs to a case beside its recipe. */
function leaveCase(): void {
  forgetSides();
  forgetPainting();
  ownColours.value = {};
}

/** Twice the geometric mean of the spacing: fine enough for the shape, coarse enough for a first look. */
function startingEdge(summary: VolumeSummary): number {
  const [x, y, z] = summary.spacing_mm;
  return Number((2 * Math.cbrt(x * y * z)).toPrecision(2));
}

export async function openFragment(fragment: string): Promise<void> {
  try {
    await offerCase(await decodeFragment(fragment));
  } catch (error) {
    tellError(error);
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

/** Takes up the case that the last page left; by itself only where the engine was at rest. */
export async function resumeCase(): Promise<void> {
  try {
    const found = await savedCase();
    if (found) {
      const { saved, interrupted } = found;
      const digest = saved.recipe.source.file?.sha256;
      if (digest && saved.file) engine.keepVolume(digest, saved.file);
      const { fitted, left } = fitRecipe(saved.recipe, defaults.value ?? {});
      const accepted = withoutPromise((await engine.checkRecipe(fitted)).recipe);
      const expected = left.length === 0 ? saved.expected : null;
      const { colours, sides } = saved;
      offered.value = { recipe: accepted, expected, origin: 'interrupted', colours, sides };
      if (left.length > 0)
        tell('error', 'Your last case was made with another version', `Left out of it: ${left.join(', ')}.`);
      if (!interrupted) acceptOffer(false);
    }
  } catch (error) {
    // Without storage there is nothing to take up, and nothing to say.
    offered.value = null;
    if (error instanceof EngineError)
      tell('error', 'Your last case cannot be taken up', `The engine refuses it: ${error.message}.`);
  }
}

export function keepSaving(): void {
  autosave((digest) => engine.volumeFile(digest));
}

/** Checks a case and holds it for the user's word; nothing of it runs. */
async function offerCase(value: Record<string, unknown>): Promise<void> {
  const { recipe: full } = await engine.checkRecipe(value);
  const promise = (full as Recipe & { expected?: Expected }).expected;
  offered.value = {
    recipe: withoutPromise(full),
    expected: promise?.digest ? promise : null,
    origin: 'link',
    colours: {},
    sides: [],
  };
}

export function acceptOffer(thenRun: boolean): void {
  const offer = offered.value;
  if (!offer) return;
  closeOffer();
  leaveCase();
  startRecipe(offer.recipe);
  ownColours.value = offer.colours;
  offer.sides.forEach(holdSide);
  restorePainting();
  expectation.value = offer.expected ? { expected: offer.expected, recipe: offer.recipe } : null;
  forgetResults();
  resetView();
  const file = offer.recipe.source.file;
  if (file && !(file.sha256 && engine.volumeFile(file.sha256))) {
    awaitedFile.value = file;
    volume.value = null;
    return;
  }
  awaitedFile.value = null;
  volume.value = null;
  void (async () => {
    await preview(true);
    if (thenRun && volume.value) await runAll();
  })();
}

/** The link has been dealt with: a reload goes on with the case as it then stands. */
export function closeOffer(): void {
  offered.value = null;
  history.replaceState(null, '', location.pathname + location.search);
}

export async function undoEdit(): Promise<void> {
  await strokesDone();
  undo();
  afterHistory();
}

export async function redoEdit(): Promise<void> {
  await strokesDone();
  redo();
  afterHistory();
}

/** The user's own colour of a label, as a step of the history. */
export function editColour(label: number, colour: string): void {
  const before = ownColours.value;
  const after = { ...before, [label]: colour };
  ownColours.value = after;
  const beside = {
    undo: () => void (ownColours.value = before),
    redo: () => void (ownColours.value = after),
  };
  editRecipe('Colour of label', () => undefined, `colour ${label}`, undefined, beside);
}

function afterHistory(): void {
  if (recipe.value?.source.phantom || recipe.value?.source.file) previewSoon();
}

/** Tetrahedra to expect of the recipe as it stands, or nothing before a volume is known. */
export function expectedTets(): number | null {
  return recipe.value && volume.value ? estimateTets(recipe.value, volume.value) : null;
}

function withoutPromise(full: Recipe): Recipe {
  const copy = structuredClone(full) as Recipe & { expected?: unknown };
  delete copy.expected;
  return copy;
}
