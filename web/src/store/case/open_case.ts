/** What the user can do: each action moves the store, and asks the engine where that needs it. */
import { signal } from '@preact/signals';
import type { EngineClient } from '../../engine/client';
import {
  EngineError,
  type Expected,
  type Labels,
  type PhantomParams,
  type Recipe,
  type SharedView,
  type VolumeSummary,
} from '../../engine/contract';
import { canonicalJson } from '../../link/canonical';
import { decodeFragment } from '../../link/codec';
import { caseInAddress, keepAddress, nameEntry } from './keep/address';
import { autosave, savedCase, type SavedCase } from './keep/autosave';
import { engine, tellError } from '../run/engine';
import {
  engineOf,
  ownEngine,
  release,
  startOwn,
  workWith,
  type EngineMaker,
  type StartedEngine,
} from './keep/kept_engines';
import { fitRecipe } from './fit_recipe';
import type { Example } from './gallery';
import { awaitedFile, volume } from './input';
import { amendRecipe, editRecipe, hasSource, recipe, redo, startRecipe, undo } from './recipe';
import { dismissErrors, tell } from '../notices';
import { expectation, type Expectation } from '../run/report';
import { activity, defaults, forgetResults } from '../run/stages';
import { budgetTets, edgeFor } from '../run/budget';
import { keepResult, showResult } from '../run/results';
import { cancelRun, preview, previewSoon, runAll } from '../run/run_stages';
import { remoteAsked, remoteInAddress } from './remote';
import { awaitedView } from './shared_view';
import { forgetSides, holdSide, type SideFile } from './side_files';
import { sameRecipe } from '../run/stage_inputs';
import { forgetPainting, restorePainting, strokesDone } from './painting';
import { resetView } from '../view';

/** A case that a link or a file offers, checked and waiting for the user's word. */
export interface OfferedCase {
  /** The name of a case that is taken up again. */
  id?: string;
  recipe: Recipe;
  promise: Expectation | null;
  origin: 'link' | 'file' | 'interrupted';
  /** Masks and images of sizes that are at hand. */
  sides: SideFile[];
  /** What it wants to be seen first. */
  view: SharedView | null;
  /** That has checked it, and will work on it. */
  engine: StartedEngine;
}

export const offered = signal<OfferedCase | null>(null);

export async function startEngine(client: EngineClient, makeKept?: EngineMaker): Promise<void> {
  try {
    await startOwn(client, makeKept);
    if (defaults.value) startRecipe(defaults.value);
    activity.value = 'idle';
  } catch (error) {
    activity.value = 'idle';
    tellError(error);
  }
}

export function openExample({ recipe: value }: Pick<Example, 'recipe'>): Promise<void> {
  return openOwn(value);
}

export function openPhantom(params: Partial<PhantomParams>): Promise<void> {
  return openOwn({ source: { phantom: params as Record<string, unknown> } });
}

/** Opens a case of the page's own, about which there is nothing to ask. */
async function openOwn(value: Record<string, unknown>): Promise<void> {
  dismissErrors();
  try {
    await offerCase(value);
    void acceptOffer(false);
  } catch (error) {
    tellError(error);
  }
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
export function takeVolume(
  summary: VolumeSummary,
  fileName: string,
  reading: Partial<Recipe['source']> = {},
  labels?: Labels,
): void {
  const awaited = awaitedFile.value;
  if (!awaited) return beginCase(summary, fileName, reading, labels);
  if (awaited.sha256 && awaited.sha256 !== summary.digest) {
    tell(
      'error',
      'This is not the expected volume',
      `${fileName} holds other voxels than the case was made from (digest ${summary.digest.slice(0, 12)}…, ` +
        `expected ${awaited.sha256.slice(0, 12)}…). The case is kept; drop ${awaited.name} to go on.`,
      { name: 'Open it as a new case', go: () => beginCase(summary, fileName) },
    );
    return;
  }
  const file = { ...awaited, name: fileName, sha256: summary.digest };
  amendRecipe((draft) => void (draft.source.file = file));
  // It is the promised volume, under whatever name.
  const promise = expectation.value;
  if (promise) {
    const source = { ...promise.recipe.source, file };
    expectation.value = { ...promise, recipe: { ...promise.recipe, source } };
  }
  showVolume(summary, labels);
}

function beginCase(
  summary: VolumeSummary,
  fileName: string,
  reading: Partial<Recipe['source']> = {},
  labels?: Labels,
): void {
  const own = ownEngine();
  if (!own) return;
  closeOffer();
  if (engine !== own.client) workWith(own);
  const fresh = structuredClone(own.info.defaults);
  const source = { ...fresh.source, ...reading, file: { name: fileName, sha256: summary.digest, url: '' } };
  leaveCase();
  engine.files.forgetVolumes(summary.digest);
  dismissErrors();
  startRecipe({ ...fresh, source, sizing: { ...fresh.sizing, edge_mm: startingEdge(summary) } });
  expectation.value = null;
  awaitedView.value = null;
  showVolume(summary, labels);
}

/** The key of labels that were read, before their stage has given them one. */
const asRead = 'as read';

function showVolume(summary: VolumeSummary, labels?: Labels): void {
  awaitedFile.value = null;
  volume.value = summary;
  forgetResults();
  resetView();
  if (labels) {
    keepResult('volume', asRead, { labels });
    showResult('volume', asRead);
  }
  void preview(true);
}

/** Forgets what belongs to a case beside its recipe. */
function leaveCase(): void {
  forgetSides();
  forgetPainting();
}

/**
 * Twice the geometric mean of the spacing: fine enough for the shape, coarse enough for a first look. Longer where the
 * labels would then be filled with more tetrahedra than a first look needs.
 */
function startingEdge({ spacing_mm: [x, y, z], labels }: VolumeSummary): number {
  const voxel = x * y * z;
  const volume = labels.reduce((sum, { voxels }) => sum + voxels * voxel, 0);
  return Number(Math.max(2 * Math.cbrt(voxel), edgeFor(volume, budgetTets)).toPrecision(2));
}

/** Asks about the case of a link. */
export async function openFragment(fragment: string): Promise<void> {
  try {
    await offerCase(await decodeFragment(fragment), 'link');
  } catch (error) {
    tellError(error);
  }
}

/**
 * Opens what the page begins with: the case of the address bar, else the one that was saved last. What the page itself
 * has put into the address, or has saved, is the user's own: there is nothing to ask.
 */
export async function openAddress(): Promise<void> {
  remoteAsked.value = remoteInAddress(location.search);
  const { link, own, changedAt = 0 } = caseInAddress();
  // Without storage there is nothing to take up, and nothing to say.
  const found = await savedCase().catch(() => null);
  if (found && (!link || own === found.saved.id)) {
    const later = link && changedAt > found.saved.changedAt ? link : null;
    return resumeCase(found, later);
  }
  if (!link) return;
  await openFragment(link);
  const offer = offered.value;
  if (!offer) return;
  if (found && isOf(found.saved, offer)) return resumeCase(found, null, offer.view);
  if (own && !found?.interrupted) void acceptOffer(false);
}

/** Whether a link brings the case that was saved, and promises no more of it. */
function isOf(saved: SavedCase, offer: OfferedCase): boolean {
  const promised = offer.promise?.expected;
  return (
    sameRecipe(saved.recipe, offer.recipe) &&
    (!promised || canonicalJson(promised) === canonicalJson(saved.promise?.expected))
  );
}

/** A saved recipe as an engine knows it; where it refuses it whole, without the fields that are gone, `left`. */
async function acceptSaved(
  saved: Recipe,
  { client, info }: StartedEngine,
): Promise<{ recipe: Recipe; left: string[] }> {
  try {
    return { recipe: (await client.checkRecipe(saved)).recipe, left: [] };
  } catch (error) {
    const { fitted, left } = fitRecipe(saved, info.defaults);
    if (left.length === 0) throw error;
    return { recipe: (await client.checkRecipe(fitted)).recipe, left };
  }
}

/**
 * Takes up the case that the last page left; by itself only where the engine was at rest. An edit that reached the
 * address bar but was not saved any more is in `laterLink`.
 */
async function resumeCase(
  { saved, interrupted }: NonNullable<Awaited<ReturnType<typeof savedCase>>>,
  laterLink: string | null = null,
  view: SharedView | null = null,
) {
  let maker: StartedEngine | undefined;
  try {
    const last = laterLink ? ((await decodeFragment(laterLink)) as unknown as Recipe) : saved.recipe;
    const digest = saved.recipe.source.file?.sha256;
    if (digest && saved.file) engine.files.keepVolume(digest, saved.file);
    maker = await engineOf(saved.promise?.expected.engine);
    const { recipe: known, left } = await acceptSaved(last, maker);
    const { recipe: accepted } = apart(known);
    const { id, sides } = saved;
    const promise = left.length === 0 ? saved.promise : null;
    offer({ id, recipe: accepted, promise, origin: 'interrupted', sides, view, engine: maker });
    if (left.length > 0)
      tell('error', 'Your last case was made with another version', `Left out of it: ${left.join(', ')}.`);
    if (!interrupted) void acceptOffer(false);
  } catch (error) {
    if (maker) release(maker);
    offered.value = null;
    if (error instanceof EngineError)
      tell('error', 'Your last case cannot be taken up', `The engine refuses it: ${error.message}.`);
  }
}

/** From now on the case is saved with each change, and stands in the address bar. */
export function keepCase(): void {
  autosave((digest) => engine.files.volume(digest));
  keepAddress(() => offered.value !== null, openFragment);
}

/** Checks a case and holds it for the user's word; nothing of it runs. */
export async function offerCase(
  value: Record<string, unknown>,
  origin: 'link' | 'file' = 'file',
): Promise<void> {
  // Before the check: the engine that made a case knows its fields.
  const promised = (value.expected as { engine?: unknown } | undefined)?.engine;
  const maker = await engineOf(typeof promised === 'string' ? promised : undefined);
  try {
    const { recipe: full } = await maker.client.checkRecipe(value);
    const { recipe: accepted, expected, view } = apart(full);
    const promise = expected?.digest ? { expected, recipe: accepted } : null;
    offer({ recipe: accepted, promise, origin, sides: [], view: view ?? null, engine: maker });
  } catch (error) {
    release(maker);
    throw error;
  }
}

function offer(next: OfferedCase): void {
  closeOffer();
  offered.value = next;
}

/** Opens the case that is offered; ends with its surface, or its mesh. */
export async function acceptOffer(thenRun: boolean): Promise<void> {
  const offer = offered.value;
  if (!offer) return;
  offered.value = null;
  // What the engine is at belongs to the case that is left.
  if (activity.value !== 'idle') void cancelRun();
  workWith(offer.engine);
  leaveCase();
  startRecipe(offer.recipe, offer.id);
  if (offer.origin !== 'file') nameEntry();
  offer.sides.forEach(holdSide);
  restorePainting();
  expectation.value = offer.promise;
  forgetResults();
  resetView();
  awaitedView.value = offer.view;
  const file = offer.recipe.source.file;
  engine.files.forgetVolumes(file?.sha256);
  volume.value = null;
  if (file && !(file.sha256 && engine.files.volume(file.sha256))) {
    awaitedFile.value = file;
    return;
  }
  awaitedFile.value = null;
  if ((await preview(true)) && thenRun) await runAll();
}

export function closeOffer(): void {
  if (offered.value) release(offered.value.engine);
  offered.value = null;
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

function afterHistory(): void {
  if (recipe.value && hasSource(recipe.value)) previewSoon();
}

/** The recipe, and what stands beside it in a case. */
function apart(full: Recipe): { recipe: Recipe; expected?: Expected; view?: SharedView } {
  const { expected, view, ...recipe } = structuredClone(full) as Recipe & {
    expected?: Expected;
    view?: SharedView;
  };
  return { recipe, expected: expected && promiseIn(expected), view };
}

/** A promise without what it leaves open. */
function promiseIn({ engine, digest, tets, physics, stages }: Expected): Expected {
  const simulated = Object.values(stages ?? {}).some((digest) => digest !== '');
  return { engine, digest, tets, ...(simulated && { physics, stages }) };
}
