/** The sizing stage's results as fields on their grids. */
import type { Vec3 } from '../../engine/contract';
import { innerGrid, type Grid } from '../../geometry/grid_values';
import { shownResult } from './results';
import { stages } from './stages';

export interface Field {
  values: Float32Array;
  grid: Grid;
}

/** The engine puts this many points around the volume on each side. */
const margin = 2;

/** The least and the largest thickness that was measured, mm. */
export function thicknessRange(): [number, number] | null {
  let [least, most] = [Infinity, 0];
  for (const value of sizingFields()?.thickness?.values ?? []) {
    if (!(value > 0)) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  return most > 0 ? [least, most] : null;
}

/** What is shown of the stage; thickness only where the recipe names walls. Reading subscribes to the result. */
export function sizingFields(): { size: Field; thickness: Field | null } | null {
  const found = shownResult('sizing');
  const counts = stages.peek().sizing.summary?.counts as { size: Vec3; index_to_mm: number[] } | undefined;
  if (!found || !counts) return null;
  const grid: Grid = { size: counts.size, indexToMm: counts.index_to_mm };
  const inner = innerGrid(grid, margin);
  return {
    size: { values: found.h_mm, grid },
    thickness: found.thickness_mm ? { values: found.thickness_mm, grid: inner } : null,
  };
}
