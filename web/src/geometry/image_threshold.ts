/** Which values of an image may be one structure. */
import type { Histogram, VolumeSummary } from '../engine/contract';

/** How many voxels have which value. */
export interface ImageValues {
  smallest: number;
  largest: number;
  histogram: Histogram;
}

const bins = 128;

/** The values of a file that was read as labels; its background has the value 0. */
export function valuesOf({ size, labels }: Pick<VolumeSummary, 'size' | 'labels'>): ImageValues {
  const others = labels.reduce((sum, { voxels }) => sum + voxels, 0);
  const background = size[0] * size[1] * size[2] - others;
  const all = background > 0 ? [{ label: 0, voxels: background }, ...labels] : labels;
  const smallest = Math.min(...all.map(({ label }) => label));
  const largest = Math.max(...all.map(({ label }) => label));
  const counts = new Array<number>(bins).fill(0);
  const width = (largest + 1 - smallest) / bins;
  for (const { label, voxels } of all) counts[Math.floor((label - smallest) / width)] += voxels;
  return { smallest, largest, histogram: { lo: smallest, hi: largest + 1, counts } };
}

/** The value that parts a histogram into the two classes that differ most (Otsu, IEEE Trans. SMC 9, 1979). */
export function otsu({ lo, hi, counts }: Histogram): number {
  const width = (hi - lo) / counts.length;
  const total = counts.reduce((sum, count) => sum + count, 0);
  const all = counts.reduce((sum, count, bin) => sum + count * bin, 0);
  let [below, sumBelow, best, at] = [0, 0, -1, 0];
  counts.forEach((count, bin) => {
    below += count;
    sumBelow += count * bin;
    const above = total - below;
    if (below === 0 || above === 0) return;
    const between = below * above * (sumBelow / below - (all - sumBelow) / above) ** 2;
    if (between > best) [best, at] = [between, bin + 1];
  });
  return lo + at * width;
}
