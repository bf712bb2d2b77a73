import type { TetArrays } from '../engine/contract';

type Tets = Pick<TetArrays, 'points' | 'tets' | 'labels' | 'neighbours'>;

/** What a view needs of a mesh beside its points and corners: half-faces in drawing order, and centroids. */
export function tetFaces({
  points,
  tets,
  labels,
  neighbours,
}: Tets): Pick<TetArrays, 'faces' | 'centres' | 'ways' | 'extents'> {
  let outer = 0;
  let between = 0;
  for (let half = 0; half < neighbours.length; half++) {
    const other = neighbours[half];
    if (other < 0) outer++;
    else if (labels[other] !== labels[half >> 2]) between++;
  }
  const inner = (neighbours.length - outer - between) / 2;
  const faces = new Uint32Array(outer + between + inner);
  const next = [0, outer, outer + between];
  for (let half = 0; half < neighbours.length; half++) {
    const other = neighbours[half];
    const own = half >> 2;
    if (other < 0) faces[next[0]++] = half;
    else if (labels[other] !== labels[own]) faces[next[1]++] = half;
    else if (own < other) faces[next[2]++] = half;
  }
  const { centres, reach } = centroids(points, tets, labels);
  return {
    faces,
    centres,
    ways: waysApart(centres),
    extents: Float64Array.of(outer, outer + between, reach),
  };
}

function centroids(points: Float32Array, tets: Uint32Array, labels: Uint16Array) {
  const centres = new Float32Array(4 * labels.length);
  let reach = 0;
  for (let t = 0; t < labels.length; t++) {
    for (let d = 0; d < 3; d++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += points[3 * tets[4 * t + k] + d];
      centres[4 * t + d] = sum / 4;
    }
    centres[4 * t + 3] = labels[t];
    for (let k = 0; k < 4; k++) {
      const p = 3 * tets[4 * t + k];
      const x = points[p] - centres[4 * t];
      const y = points[p + 1] - centres[4 * t + 1];
      const z = points[p + 2] - centres[4 * t + 2];
      reach = Math.max(reach, x * x + y * y + z * z);
    }
  }
  return { centres, reach: Math.sqrt(reach) };
}

/** From the body's middle to the middle of each label: the way it goes when the labels are pulled apart. */
function waysApart(centres: Float32Array): Float32Array {
  const sums = new Map<number, number[]>();
  const whole = [0, 0, 0, 0];
  for (let i = 0; i < centres.length; i += 4) {
    let sum = sums.get(centres[i + 3]);
    if (!sum) sums.set(centres[i + 3], (sum = [0, 0, 0, 0]));
    for (let d = 0; d < 3; d++) {
      sum[d] += centres[i + d];
      whole[d] += centres[i + d];
    }
    sum[3]++;
    whole[3]++;
  }
  return Float32Array.from(
    [...sums].flatMap(([label, sum]) => [
      label,
      ...[0, 1, 2].map((d) => sum[d] / sum[3] - whole[d] / whole[3]),
    ]),
  );
}

/** Bits of a tet's mask. */
export const shownBit = 1;
export const chosenBit = 2;
export const nearBit = 4;

export interface TetChoice {
  hidden: ReadonlySet<number>;
  /** Choose tets within a range of these values, any of the arrays. */
  ranges?: { values: readonly Float32Array[]; lo: number; hi: number };
  /** Choose this one tet, whatever the ranges; those whose centroid is within a radius of its own are near. */
  single?: { tet: number; radius: number };
}

/** One byte a tet: whether its label is shown, whether it is chosen, and whether it is near; and how many are chosen. */
export function tetMask(centres: Float32Array, choice: TetChoice): { mask: Uint8Array; count: number } {
  const mask = new Uint8Array(centres.length / 4);
  const { hidden, ranges, single } = choice;
  if (single) return { mask: maskAround(centres, hidden, single), count: 1 };
  let count = 0;
  for (let t = 0; t < mask.length; t++) {
    if (hidden.has(centres[4 * t + 3])) continue;
    mask[t] = shownBit;
    if (ranges && !ranges.values.some((values) => values[t] >= ranges.lo && values[t] <= ranges.hi)) continue;
    mask[t] |= chosenBit;
    count++;
  }
  return { mask, count };
}

function maskAround(
  centres: Float32Array,
  hidden: ReadonlySet<number>,
  { tet, radius }: NonNullable<TetChoice['single']>,
): Uint8Array {
  const mask = new Uint8Array(centres.length / 4);
  const [x, y, z] = centres.subarray(4 * tet);
  for (let t = 0; t < mask.length; t++) {
    if (hidden.has(centres[4 * t + 3])) continue;
    const away = (centres[4 * t] - x) ** 2 + (centres[4 * t + 1] - y) ** 2 + (centres[4 * t + 2] - z) ** 2;
    mask[t] = away > radius ** 2 ? shownBit : shownBit | nearBit;
  }
  // Even where its label is hidden.
  mask[tet] |= chosenBit;
  return mask;
}
