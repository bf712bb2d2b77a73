/** Sizes painted over the volume: a mask of the recipe that the page makes itself. */
import { signal } from '@preact/signals';
import type { Grid } from '../../geometry/grid_values';
import { readOwnNrrd, volumeDigest, writeNrrd } from '../../geometry/nrrd';
import {
  applyRuns,
  countLabels,
  dabsBetween,
  paintDab,
  runsOf,
  type Runs,
  type Stroke,
} from '../../geometry/painting';
import { engine, tellError } from '../run/engine';
import { tell } from '../notices';
import { shownResult } from '../run/results';
import { volume } from './input';
import { meshedLabels } from './labels';
import { nameOf } from './legend/legend';
import { editRecipe, recipe } from './recipe';
import { holdSide } from './side_files';

/** The name under which the recipe asks for what is painted here. */
export const paintedName = 'painted.nrrd';
const mostSizes = 255;

export interface BrushTool {
  on: boolean;
  erases: boolean;
  /** One slice at a time; else a ball. */
  flat: boolean;
  radius_mm: number;
  edge_mm: number;
}

export const brushTool = signal<BrushTool>({
  on: false,
  erases: false,
  flat: false,
  radius_mm: 6,
  edge_mm: 1,
});

/** The least and the largest radius of the brush, mm: half a voxel, and twenty. */
export function brushRadiiMm(): [number, number] {
  const voxel = Math.min(...(volume.value?.spacing_mm ?? [1]));
  return [0.5 * voxel, 20 * voxel];
}

export interface Painting {
  grid: Grid;
  /** Of each voxel the label of its size; 0: none. */
  labels: Uint8Array;
}

let painting: Painting | null = null;
const revision = signal(0);
let stroke: (Stroke & { edge_mm: number; at: readonly number[]; across: number | null }) | null = null;
/** Strokes become steps of the history in their order, each once its digest is known. */
let pending: Promise<void> = Promise.resolve();
/** Sizes of labels whose first stroke is not yet a step. */
const coming = new Map<number, number>();

/** Voxels as they are painted now. Reading subscribes to every change of them. */
export function paintedVoxels(): Painting | null {
  void revision.value;
  return painting;
}

export const paintedEdges = () =>
  recipe.value?.sizing.masks.find(({ name }) => name === paintedName)?.edges ?? [];

/** Ends the stroke under way; resolves when every stroke is a step of the history. */
export function strokesDone(): Promise<void> {
  endStroke();
  return pending;
}

export function forgetPainting(): void {
  painting = null;
  stroke = null;
  coming.clear();
  brushTool.value = { ...brushTool.value, on: false };
  revision.value++;
}

/** Takes up what was painted in an earlier session, from its file. */
export function restorePainting(): void {
  const file = paintedEdges().length > 0 ? engine.files.side('mask', paintedName) : undefined;
  const found = file && readOwnNrrd(file.bytes);
  if (!found || painting) return;
  painting = { grid: found.grid, labels: found.voxels };
  revision.value++;
}

function canvas(): Painting | null {
  const known = volume.peek();
  if (!painting && known) {
    const count = known.size.reduce((product, n) => product * n, 1);
    painting = { grid: { size: known.size, indexToMm: known.index_to_mm }, labels: new Uint8Array(count) };
  }
  return painting;
}

/** The label that stands for a size; 0 when there are none left. */
function labelOf(edge_mm: number): number {
  const known = new Map([...coming, ...paintedEdges().map((one) => [one.label, one.edge_mm] as const)]);
  for (const [label, edge] of known) if (edge === edge_mm) return label;
  for (let label = 1; label <= mostSizes; label++) if (!known.has(label)) return label;
  return 0;
}

/** Begins a stroke at a place of a slice across an axis; another that has not ended does. */
export function beginStroke(mm: readonly number[], across: number): void {
  endStroke();
  const { erases, flat, edge_mm } = brushTool.value;
  const label = erases ? 0 : labelOf(edge_mm);
  if (!canvas() || (label === 0 && !erases)) return;
  if (label > 0) coming.set(label, edge_mm);
  stroke = { label, voxels: [], before: [], edge_mm, at: mm, across: flat ? across : null };
  continueStroke(mm);
}

export function continueStroke(mm: readonly number[]): void {
  if (!stroke || !painting) return;
  const { radius_mm } = brushTool.value;
  for (const place of dabsBetween(stroke.at, mm, radius_mm))
    paintDab(
      painting.labels,
      painting.grid,
      { mm: place, radiusMm: radius_mm, across: stroke.across },
      stroke,
    );
  stroke.at = mm;
  revision.value++;
}

/** Takes back the stroke under way. */
export function dropStroke(): void {
  if (!stroke || !painting) return;
  applyRuns(painting.labels, runsOf(stroke), 'before');
  stroke = null;
  revision.value++;
}

export function endStroke(): void {
  if (!stroke) return;
  const done = stroke;
  stroke = null;
  if (done.voxels.length === 0) return;
  if (done.label > 0) tellWhereIdle(done.voxels);
  commit(done.label === 0 ? 'Erase size' : 'Paint size', done, done.edge_mm);
}

/** Says where all of a stroke is in labels that are not meshed. */
function tellWhereIdle(voxels: readonly number[]): void {
  const labels = shownResult('volume')?.labels;
  if (!labels || voxels.some((voxel) => meshedLabels.peek().has(labels[voxel]))) return;
  const name = nameOf(labels[voxels[voxels.length - 1]]);
  const text = `The ${name} is not meshed: sizes painted there count only near labels that are.`;
  tell('news', 'Painted where nothing is meshed', text);
}

/** Takes a size off wherever it is painted. */
export function erasePainted(label: number): void {
  if (!painting) return;
  const all: Stroke = { label: 0, voxels: [], before: [] };
  painting.labels.forEach((own, voxel) => {
    if (own !== label) return;
    all.voxels.push(voxel);
    all.before.push(label);
  });
  const runs = runsOf(all);
  applyRuns(painting.labels, runs, 'after');
  revision.value++;
  commit('Remove painted size', all, 0);
}

export function setPaintedEdge(label: number, edge_mm: number): void {
  editRecipe(
    'Painted size',
    (draft) => {
      const edges = draft.sizing.masks.find(({ name }) => name === paintedName)?.edges;
      const own = edges?.find((one) => one.label === label);
      if (own) own.edge_mm = edge_mm;
    },
    `painted ${label}`,
  );
}

function commit(text: string, done: Stroke, edge_mm: number): void {
  if (!painting) return;
  const { grid, labels } = painting;
  const counts = countLabels(labels);
  const digest = volumeDigest(grid, labels);
  // Now: the next stroke may be under way by the time that the digest is known.
  const bytes = writeNrrd(grid, labels);
  const runs = runsOf(done);
  const settle = async () => {
    const after = await digest;
    if (painting?.labels !== labels) return;
    const before = recipe.peek()?.sizing.masks.find(({ name }) => name === paintedName)?.sha256 ?? '';
    hand(bytes, after);
    editRecipe(text, (draft) => setEdges(draft.sizing, done.label, edge_mm, counts, after), undefined, 0, {
      undo: () => turn(runs, 'before', before),
      redo: () => turn(runs, 'after', after),
    });
  };
  pending = pending
    .then(settle)
    .catch((error: unknown) => {
      applyRuns(labels, runs, 'before');
      revision.value++;
      tellError(error);
    })
    .then(() => void coming.delete(done.label));
}

type Sizing = NonNullable<typeof recipe.value>['sizing'];

/** The recipe's entry names the sizes that are still somewhere; without any there is none. */
function setEdges(
  sizing: Sizing,
  label: number,
  edge_mm: number,
  counts: Map<number, number>,
  sha256: string,
) {
  const old = sizing.masks.find(({ name }) => name === paintedName)?.edges ?? [];
  const all = label === 0 || old.some((one) => one.label === label) ? old : [...old, { label, edge_mm }];
  const edges = all.filter((one) => counts.has(one.label)).sort((a, b) => a.label - b.label);
  sizing.masks = sizing.masks.filter(({ name }) => name !== paintedName);
  if (edges.length > 0) sizing.masks.push({ name: paintedName, sha256, edges });
}

function turn(runs: Runs, way: 'before' | 'after', digest: string): void {
  if (!painting) return;
  applyRuns(painting.labels, runs, way);
  revision.value++;
  hand(writeNrrd(painting.grid, painting.labels), digest);
}

/** The engine reads what is painted as a file, once a stage needs it. */
function hand(bytes: Uint8Array<ArrayBuffer>, digest: string): void {
  holdSide({ kind: 'mask', file: { name: paintedName, bytes, siblings: {} }, digest });
}
