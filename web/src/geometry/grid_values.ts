/** Numbers on a regular grid, and what they are at other places. */
import { indexMap, toMm } from './orientation';

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export interface Grid {
  size: readonly number[];
  /** 4×4, row-major. */
  indexToMm: readonly number[];
}

/** The grid without `points` grid points on each side. */
export function innerGrid({ size, indexToMm }: Grid, points: number): Grid {
  const origin = toMm(indexToMm, [points, points, points]);
  return {
    size: size.map((n) => n - 2 * points),
    indexToMm: indexToMm.map((entry, i) => (i % 4 === 3 && i < 12 ? origin[(i - 3) / 4] : entry)),
  };
}

/** The mean of the grid points around a place that hold a value, by weights that reach nothing at `reach` steps. */
function weighted(
  values: Float32Array,
  [nx, ny, nz]: readonly number[],
  [i, j, k]: readonly number[],
  reach: number,
): number {
  let sum = 0;
  let weights = 0;
  for (let ck = Math.max(0, Math.floor(k) - reach + 1); ck <= Math.min(nz - 1, Math.floor(k) + reach); ck++)
    for (let cj = Math.max(0, Math.floor(j) - reach + 1); cj <= Math.min(ny - 1, Math.floor(j) + reach); cj++)
      for (
        let ci = Math.max(0, Math.floor(i) - reach + 1);
        ci <= Math.min(nx - 1, Math.floor(i) + reach);
        ci++
      ) {
        const value = values[ci + nx * (cj + ny * ck)];
        const weight = (reach - Math.abs(i - ci)) * (reach - Math.abs(j - cj)) * (reach - Math.abs(k - ck));
        if (!(value > 0) || weight < 1e-6) continue;
        sum += weight * value;
        weights += weight;
      }
  return weights > 0 ? sum / weights : NaN;
}

/**
 * Values at places, three numbers each in mm: trilinear among the grid points around a place that hold one (more than
 * 0), else those within two steps, else NaN.
 */
export function valuesAt(
  values: Float32Array,
  { size, indexToMm }: Grid,
  places: Float32Array,
): Float32Array {
  const out = new Float32Array(places.length / 3).fill(NaN);
  const m = indexMap(identity, indexToMm);
  const [nx, ny, nz] = size;
  for (let p = 0; p < out.length; p++) {
    const [x, y, z] = [places[3 * p], places[3 * p + 1], places[3 * p + 2]];
    const i = Math.max(0, Math.min(nx - 1, m[0] * x + m[1] * y + m[2] * z + m[3]));
    const j = Math.max(0, Math.min(ny - 1, m[4] * x + m[5] * y + m[6] * z + m[7]));
    const k = Math.max(0, Math.min(nz - 1, m[8] * x + m[9] * y + m[10] * z + m[11]));
    out[p] = weighted(values, size, [i, j, k], 1);
    // Beside a field with gaps: what is within another step.
    if (Number.isNaN(out[p])) out[p] = weighted(values, size, [i, j, k], 2);
  }
  return out;
}
