import { computed, signal } from '@preact/signals';
import type { Recipe, VolumeSummary } from '../../engine/contract';

/** The label volume that the case stands on, once it has been read or generated. */
export const volume = signal<VolumeSummary | null>(null);

export const voxelCount = computed(() => volume.value?.size.reduce((product, n) => product * n, 1) ?? 0);

/** The mesh was made elsewhere: it is shown, measured and simulated on, but not made. */
export const meshIsGiven = computed(() => volume.value?.mesh !== undefined);

/** The file of the mesh gave fibres with it. */
export const fibresAreGiven = computed(() => volume.value?.mesh?.fibres ?? false);

/** The file that is being read, or was last. */
export const fileRead = signal('');

/** A file that the recipe needs and that has not been dropped in yet. */
export const awaitedFile = signal<NonNullable<Recipe['source']['file']> | null>(null);

/** The smallest voxel spacing of the grid that is meshed, mm. */
export const voxelMm = computed(() => {
  const known = volume.value;
  return Math.min(...((known?.prepared ?? known)?.spacing_mm ?? [1]));
});

/** Names of the files that a case is made from. */
export function filesOf({ source, sizing }: Recipe): string[] {
  const all = [...(source.file ? [source.file] : []), ...sizing.masks, ...sizing.images];
  return all.map(({ name }) => name);
}
