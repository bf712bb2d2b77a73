/** How the values of a column spread, and which of them lie far outside. */
import type { Histogram } from '../../engine/contract';

/** The median, and the standard deviation that a normal distribution with this median absolute deviation has. */
export interface Spread {
  median: number;
  deviation: number;
}

/** Values further than so many robust standard deviations from the median are outliers. */
export const outlierLimit = 3;

function medianOf(values: readonly number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/** Of at least one value; null where at least half of them are the same, by which no other can be judged. */
export function spreadOf(values: readonly number[]): Spread | null {
  const median = medianOf(values);
  const deviation = 1.4826 * medianOf(values.map((value) => Math.abs(value - median)));
  return deviation > 0 ? { median, deviation } : null;
}

/** How many robust standard deviations a value lies above the median, below it where negative. */
export function deviationsOf(value: number, { median, deviation }: Spread): number {
  return (value - median) / deviation;
}

export const isOutlying = (value: number, spread: Spread): boolean =>
  Math.abs(deviationsOf(value, spread)) > outlierLimit;

/** The values outside of it are outliers. */
export function usualRange({ median, deviation }: Spread): [number, number] {
  return [median - outlierLimit * deviation, median + outlierLimit * deviation];
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
