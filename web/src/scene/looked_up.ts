import type { StageArrays } from '../engine/contract';
import { nameOf } from '../store/input';
import { fractionLabel } from '../store/view';

/** What was looked up in the image at one tet. */
export function lookedUpLines(arrays: StageArrays['quality'], tet: number): [string, string][] {
  const { centroid_label: centroid, majority_label: majority } = arrays;
  if (!centroid || !majority) return [];
  const shares = Object.entries(arrays).flatMap(([name, values]): [string, string][] => {
    const label = fractionLabel(name);
    return label === null || !values
      ? []
      : [[`Share of ${nameOf(label)}`, `${(100 * values[tet]).toFixed(0)} %`]];
  });
  return [['At its centroid', nameOf(centroid[tet])], ['Most of it', nameOf(majority[tet])], ...shares];
}
