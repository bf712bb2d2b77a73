import type { Histogram } from '../engine/contract';

/** Shares of the total (percent) in equal bins over [lo, hi]; a source bin is spread evenly over what it covers. */
export function rebin(source: Histogram, lo: number, hi: number, bins: number): Float64Array {
  const shares = new Float64Array(bins);
  const total = source.counts.reduce((sum, count) => sum + count, 0);
  if (total === 0 || !(hi > lo)) return shares;
  const sourceWidth = (source.hi - source.lo) / source.counts.length;
  const width = (hi - lo) / bins;
  const binOf = (x: number) => Math.max(0, Math.min(bins - 1, Math.floor((x - lo) / width)));
  source.counts.forEach((count, i) => {
    if (count === 0) return;
    const share = (100 * count) / total;
    const from = source.lo + i * sourceWidth;
    const to = from + sourceWidth;
    if (!(sourceWidth > 0)) {
      shares[binOf(from)] += share;
      return;
    }
    for (let bin = binOf(from); bin <= binOf(to); bin++) {
      const left = bin === 0 ? -Infinity : lo + bin * width;
      const right = bin === bins - 1 ? Infinity : lo + (bin + 1) * width;
      const covered = Math.min(to, right) - Math.max(from, left);
      if (covered > 0) shares[bin] += (share * covered) / sourceWidth;
    }
  });
  return shares;
}

/** Every value spread evenly, by its logarithm, over what is at most so many times smaller or larger. */
export function spreadByFactor(source: Histogram, factor: number): Histogram {
  const [lo, hi] = [source.lo / factor, source.hi * factor];
  const bins = 2 * source.counts.length;
  const counts = new Array<number>(bins).fill(0);
  if (!(lo >= 0 && hi > lo)) return source;
  const width = (hi - lo) / bins;
  const sourceWidth = (source.hi - source.lo) / source.counts.length;
  source.counts.forEach((count, i) => {
    if (count === 0) return;
    const middle = source.lo + (i + 0.5) * sourceWidth;
    const [from, to] = [middle / factor, middle * factor];
    const first = Math.max(0, Math.floor((from - lo) / width));
    for (let bin = first; bin < bins && lo + bin * width < to; bin++) {
      const [left, right] = [Math.max(from, lo + bin * width), Math.min(to, lo + (bin + 1) * width)];
      if (right > left) counts[bin] += (count * Math.log(right / left)) / Math.log(to / from);
    }
  });
  return { lo, hi, counts };
}

/** The part of all that lies within a range, 0 to 1; bins that reach over its ends count by what is within. */
export function shareWithin({ lo, hi, counts }: Histogram, from: number, to: number): number {
  const width = (hi - lo) / counts.length;
  const total = counts.reduce((sum, count) => sum + count, 0);
  const within = counts.reduce((sum, count, i) => {
    const left = lo + i * width;
    const part =
      width > 0
        ? (Math.min(to, left + width) - Math.max(from, left)) / width
        : Number(left >= from && left <= to);
    return sum + count * Math.max(0, Math.min(1, part));
  }, 0);
  return total > 0 ? within / total : 0;
}

/** The shortest range that holds all but `tail` percent at each end of every histogram. */
export function coveringRange(sources: readonly Histogram[], tail = 0.3): [number, number] {
  let lo = Infinity;
  let hi = -Infinity;
  for (const source of sources) {
    const total = source.counts.reduce((sum, count) => sum + count, 0);
    if (total === 0) continue;
    const limit = (total * tail) / 100;
    const width = (source.hi - source.lo) / source.counts.length;
    let first = 0;
    for (let sum = source.counts[0]; sum <= limit; sum += source.counts[first]) first++;
    let last = source.counts.length - 1;
    for (let sum = source.counts[last]; sum <= limit; sum += source.counts[last]) last--;
    lo = Math.min(lo, source.lo + first * width);
    hi = Math.max(hi, source.lo + (last + 1) * width);
  }
  if (!(hi >= lo)) return [0, 1];
  return hi > lo ? [lo, hi] : [lo - 0.5, lo + 0.5];
}
