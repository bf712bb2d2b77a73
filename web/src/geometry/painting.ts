/** Painting labels into a volume: balls of voxels, and what a stroke has changed as runs. */
import type { Grid } from './grid_values';
import { toIndex } from './orientation';

/** Voxels in a row that had one label and got another. */
export interface Runs {
  starts: Uint32Array;
  lengths: Uint32Array;
  before: Uint8Array;
  after: Uint8Array;
}

/** Where a brush touches: voxels whose middle is within a radius, of one slice only where `across` says its axis. */
export interface Dab {
  mm: readonly number[];
  radiusMm: number;
  across: number | null;
}

/** What one stroke changes; every voxel once, since a stroke has one label. */
export interface Stroke {
  label: number;
  voxels: number[];
  before: number[];
}

/** Spacings along the axes, and how far an axis' index moves per mm at most. */
function reachPerMm({ indexToMm }: Grid): number[] {
  const origin = toIndex(indexToMm, [0, 0, 0]);
  const ways = [0, 1, 2].map((row) =>
    toIndex(
      indexToMm,
      [0, 1, 2].map((other) => Number(other === row)),
    ),
  );
  return [0, 1, 2].map((axis) => Math.hypot(...ways.map((way) => way[axis] - origin[axis])));
}

/** Labels the voxels of a dab; the one under its middle always. */
export function paintDab(
  labels: Uint8Array,
  grid: Grid,
  { mm, radiusMm, across }: Dab,
  stroke: Stroke,
): void {
  const { size, indexToMm } = grid;
  const middle = toIndex(indexToMm, mm);
  const nearest = middle.map(Math.round);
  const reach = reachPerMm(grid).map((perMm) => perMm * radiusMm);
  const first = [0, 1, 2].map((axis) =>
    Math.max(
      0,
      axis === across ? nearest[axis] : Math.min(nearest[axis], Math.ceil(middle[axis] - reach[axis])),
    ),
  );
  const last = [0, 1, 2].map((axis) =>
    Math.min(
      size[axis] - 1,
      axis === across ? nearest[axis] : Math.max(nearest[axis], Math.floor(middle[axis] + reach[axis])),
    ),
  );
  const m = indexToMm;
  for (let k = first[2]; k <= last[2]; k++)
    for (let j = first[1]; j <= last[1]; j++)
      for (let i = first[0]; i <= last[0]; i++) {
        const [a, b, c] = [
          i - (across === 0 ? nearest[0] : middle[0]),
          j - (across === 1 ? nearest[1] : middle[1]),
          k - (across === 2 ? nearest[2] : middle[2]),
        ];
        const x = m[0] * a + m[1] * b + m[2] * c;
        const y = m[4] * a + m[5] * b + m[6] * c;
        const z = m[8] * a + m[9] * b + m[10] * c;
        const under = i === nearest[0] && j === nearest[1] && k === nearest[2];
        if (!under && x * x + y * y + z * z > radiusMm * radiusMm) continue;
        const voxel = i + size[0] * (j + size[1] * k);
        if (labels[voxel] === stroke.label) continue;
        stroke.voxels.push(voxel);
        stroke.before.push(labels[voxel]);
        labels[voxel] = stroke.label;
      }
}

/** Dabs along a line, close enough for the stroke to have no gaps. */
export function dabsBetween(from: readonly number[], to: readonly number[], radiusMm: number): number[][] {
  const way = to.map((x, row) => x - from[row]);
  const steps = Math.max(1, Math.ceil(Math.hypot(...way) / Math.max(0.1, radiusMm / 2)));
  return Array.from({ length: steps }, (_, step) =>
    from.map((x, row) => x + ((step + 1) / steps) * way[row]),
  );
}

export function runsOf({ label, voxels, before }: Stroke): Runs {
  const order = Uint32Array.from(voxels.keys()).sort((a, b) => voxels[a] - voxels[b]);
  const starts: number[] = [];
  const lengths: number[] = [];
  const had: number[] = [];
  for (const at of order) {
    const run = starts.length - 1;
    if (run >= 0 && voxels[at] === starts[run] + lengths[run] && before[at] === had[run]) lengths[run]++;
    else {
      starts.push(voxels[at]);
      lengths.push(1);
      had.push(before[at]);
    }
  }
  return {
    starts: Uint32Array.from(starts),
    lengths: Uint32Array.from(lengths),
    before: Uint8Array.from(had),
    after: new Uint8Array(starts.length).fill(label),
  };
}

/** Puts voxels back to what they were, or forth again. */
export function applyRuns(
  labels: Uint8Array,
  { starts, lengths, ...had }: Runs,
  way: 'before' | 'after',
): void {
  starts.forEach((start, run) => labels.fill(had[way][run], start, start + lengths[run]));
}

/** Voxels of each label that there is; background is none. */
export function countLabels(labels: Uint8Array): Map<number, number> {
  const counts = new Uint32Array(256);
  for (let i = 0; i < labels.length; i++) counts[labels[i]]++;
  return new Map([...counts.entries()].filter(([label, count]) => label > 0 && count > 0));
}
