/** How the values of a column spread, and which of them lie far outside. */
import type { Histogram } from '../../engine/contract';

/** The values below which a quarter, half and three quarters of all lie. */
export interface Spread {
  low: number;
  median: number;
  high: number;
}

/** Outliers lie farther from the quartiles than so many distances between them: beyond the outer fences of Tukey (1977). */
const fence = 3;

/** Of at least one value. */
export function spreadOf(values: readonly number[]): Spread {
  const sorted = [...values].sort((a, b) => a - b);
  const [low, median, high] = [1, 2, 3].map(
    (quarters) => sorted[Math.min(sorted.length - 1, Math.floor((sorted.length * quarters) / 4))],
  );
  return { low, median, high };
}

/** The values outside of it are outliers. */
export function usualRange({ low, high }: Spread): [number, number] {
  return [low - fence * (high - low), high + fence * (high - low)];
}

export function isOutlying(value: number, spread: Spread): boolean {
  const [least, most] = usualRange(spread);
  return value < least || value > most;
}

/** In twice as many bins as the root of the count, 5 to 56: what lies among outliers keeps its shape. */
export function histogramOf(values: readonly number[]): Histogram {
  const least = values.reduce((known, value) => Math.min(known, value), Infinity);
  const most = values.reduce((known, value) => Math.max(known, value), -Infinity);
  const [lo, hi] = most > least ? [least, most] : [least - 0.5, least + 0.5];
  const bins = Math.max(5, Math.min(56, Math.ceil(2 * Math.sqrt(values.length))));
  const counts = new Array<number>(bins).fill(0);
  for (const value of values) counts[Math.min(bins - 1, Math.floor((bins * (value - lo)) / (hi - lo)))]++;
  return { lo, hi, counts };
}
