/** The remedy for noise in a segmentation: loose pieces, holes, thin handles, tunnels and pits go. */
import type { Recipe, Schema, VolumeSummary } from '../../engine/contract';
import { schema } from '../run/stages';
import { editRecipe } from './recipe';

type CleaningLimits = NonNullable<Schema['presets']>['cleaning']['volume'];

/** Cleans as --clean of the command line does, where the recipe does not clean yet. */
export function clean(volume: Recipe['volume'], limits: CleaningLimits): void {
  for (const field of ['speck_voxels', 'hole_voxels', 'handle_voxels'] as const)
    volume[field] ||= limits[field];
}

export function cleanLabels(): void {
  const preset = schema.value?.presets?.cleaning;
  if (preset) editRecipe('Clean the labels', (draft) => clean(draft.volume, preset.volume));
}

/** Warnings without those that say a flaw, which is shown with its remedy. */
export function otherWarnings({ warnings, flaws = [] }: VolumeSummary): string[] {
  return warnings.filter((warning) => !flaws.some(({ text }) => warning.includes(text)));
}
