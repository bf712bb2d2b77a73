/** What the user can do: each action moves the store, and asks the engine where that needs it. */
import { signal } from '@preact/signals';
import type { EngineClient } from '../engine/client';
import {
  EngineError,
  type Expected,
  type PhantomParams,
  type Recipe,
  type VolumeSummary,
} from '../engine/contract';
import { decodeFragment } from '../link/codec';
import { autosave, savedCase, type SavedCase } from './autosave';
import { engine, tellError, useEngine } from './engine';
import { fitRecipe } from './fit_recipe';
import type { Example } from './gallery';
import { awaitedFile, volume } from './input';
import { amendRecipe, editRecipe, recipe, redo, startRecipe, undo } from './recipe';
import { activity, defaults, expectation, forgetResults, schema, tell } from './run';
import { preview, previewSoon, runAll } from './runs';
import { forgetSides, holdSide, type SideFile } from './side_files';
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

/** A volume has been read: it is the one that the case waits for, or begins a case. */
export function takeVolume(summary: VolumeSummary, fileName: string): void {
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
export async function offerCase(value: Record<string, unknown>): Promise<void> {
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

function withoutPromise(full: Recipe): Recipe {
  const copy = structuredClone(full) as Recipe & { expected?: unknown };
  delete copy.expected;
  return copy;
}
