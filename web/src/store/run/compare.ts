/** One run that later ones are held against. Its arrays stand outside the store, like those of the results. */
import { signal } from '@preact/signals';
import type { Recipe, Report, StageArrays } from '../../engine/contract';
import { shownResult } from './results';
import { meshedRecipe, report } from './report';
import { layout } from '../view';

export interface PinnedRun {
  report: Report;
  recipe: Recipe;
}

export interface PinnedArrays {
  mesh: StageArrays['optimise'];
  measures: StageArrays['quality'] | undefined;
}

export const pinned = signal<PinnedRun | null>(null);
let arrays: PinnedArrays | null = null;

/** The arrays of the pinned run. Reading subscribes to which run that is. */
export function pinnedArrays(): PinnedArrays | null {
  return pinned.value ? arrays : null;
}

export function pinRun(): void {
  const mesh = shownResult('optimise');
  if (!report.value || !meshedRecipe.value || !mesh) return;
  arrays = { mesh, measures: shownResult('quality') };
  pinned.value = { report: report.value, recipe: meshedRecipe.value };
}

export function unpin(): void {
  pinned.value = null;
  arrays = null;
  if (layout.value === 'compare') layout.value = 'model';
}
