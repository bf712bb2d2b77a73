/** One run that later ones are held against. Its arrays stand outside the store, like those of the results. */
import { signal } from '@preact/signals';
import {
  noValue,
  type Physics,
  type Recipe,
  type Report,
  type Simulated,
  type StageArrays,
} from '../../engine/contract';
import { chooseLayout, layout } from '../view';
import { foundPhysics, keptSimulation, simulated, simulatedPhysics, type KeptSimulation } from './frames';
import { meshedRecipe, report } from './report';
import { shownKeys, shownResult } from './results';

export interface PinnedRun {
  report: Report;
  recipe: Recipe;
  /** What its mesh was made from: on the same mesh simulations can be compared. */
  mesh: string | undefined;
  /** What was simulated on it, if anything, and its figures. */
  physics: Physics | null;
  simulated: Simulated;
}

export interface PinnedArrays {
  mesh: StageArrays['optimise'];
  measures: StageArrays['quality'] | undefined;
}

export const pinned = signal<PinnedRun | null>(null);
let arrays: PinnedArrays | null = null;
let simulation: KeptSimulation | null = null;

/** The arrays of the pinned run. Reading subscribes to which run that is. */
export function pinnedArrays(): PinnedArrays | null {
  return pinned.value ? arrays : null;
}

/** What was simulated in it, where its mesh is the one that is shown. Reading subscribes to both. */
export function pinnedSimulation(): KeptSimulation | null {
  return pinned.value && pinned.value.mesh === shownKeys.value.optimise ? simulation : null;
}

/** Values at the points of the pinned mesh, that its simulations found. */
export const pinnedFound = (name: string): Float32Array | undefined => simulation?.found.get(name);

export function pinRun(): void {
  const mesh = shownResult('optimise');
  if (!report.value || !meshedRecipe.value || !mesh) return;
  arrays = { mesh, measures: shownResult('quality') };
  simulation = keptSimulation();
  pinned.value = {
    report: report.value,
    recipe: meshedRecipe.value,
    mesh: shownKeys.value.optimise,
    physics: foundPhysics.value ?? simulatedPhysics.value,
    simulated: simulated.value,
  };
}

export function unpin(): void {
  pinned.value = null;
  arrays = null;
  simulation = null;
  if (layout.value === 'compare') chooseLayout('model');
}

export interface ValueDifferences {
  /** Now less then; `noValue` where one of the two has none. */
  values: Float32Array;
  rms: number;
  /** The largest in size, and the mean with its sign. */
  largest: number;
  mean: number;
  /** Points with a value in both runs, and in only one. */
  both: number;
  one: number;
}

export function differencesOf(now: Float32Array, before: Float32Array): ValueDifferences {
  const found = { values: now.slice(), rms: 0, largest: 0, mean: 0, both: 0, one: 0 };
  for (let i = 0; i < now.length; i++) {
    const [hasNow, hadBefore] = [now[i] > noValue, before[i] > noValue];
    if (hasNow !== hadBefore) found.one++;
    const change = now[i] - before[i];
    found.values[i] = hasNow && hadBefore ? change : noValue;
    if (!hasNow || !hadBefore) continue;
    found.both++;
    found.mean += change;
    found.rms += change * change;
    found.largest = Math.max(found.largest, Math.abs(change));
  }
  found.mean /= Math.max(1, found.both);
  found.rms = Math.sqrt(found.rms / Math.max(1, found.both));
  return found;
}
