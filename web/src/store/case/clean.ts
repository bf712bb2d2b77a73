/** The remedy for noise in a segmentation: loose pieces, holes, thin handles, tunnels and pits go. */
import type { Recipe, VolumeSummary } from '../../engine/contract';
import { editRecipe } from './recipe';

/** As --clean of the command line: what a cube of three voxels holds is the least that stays. */
export const usualCleaning = 27;

/** Cleans as usual, where the recipe does not clean yet. */
export function clean(volume: Recipe['volume']): void {
  for (const field of ['speck_voxels', 'hole_voxels', 'handle_voxels'] as const)
    volume[field] ||= usualCleaning;
}

export function cleanLabels(): void {
  editRecipe('Clean the labels', (draft) => clean(draft.volume));
}

/** Warnings without those that say a flaw, which is shown with its remedy. */
export function otherWarnings({ warnings, flaws = [] }: VolumeSummary): string[] {
  return warnings.filter((warning) => !flaws.some(({ text }) => warning.includes(text)));
}
