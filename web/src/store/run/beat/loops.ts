/** Pressure and volume of a heart's ventricles: as loops, as lines over time, as a table in a file. */
import type { Traces, Ventricle, VentricleBeat } from '../../../engine/contract';

/** Volumes and pressures of a ventricle, one after the other in time. */
export interface Loop {
  times_ms: number[];
  ml: number[];
  kpa: number[];
}

export const ventricleNames: Record<Ventricle, string> = { lv: 'Left ventricle', rv: 'Right ventricle' };
export const ventricles = ['lv', 'rv'] as const;

const valuesOf = ({ lines }: Traces, name: string): number[] | undefined =>
  lines.find((line) => line.name === name)?.values;

/** From the first beat on; filling, before it, goes from no pressure to that of the atrium. */
export function loopOf(traces: Traces, ventricle: Ventricle): Loop | null {
  const ml = valuesOf(traces, `${ventricle}_volume`);
  const kpa = valuesOf(traces, `${ventricle}_pressure`);
  if (!ml || !kpa) return null;
  const first = traces.times_ms.findIndex((time) => time > -1e-6);
  if (first < 0) return null;
  return { times_ms: traces.times_ms.slice(first), ml: ml.slice(first), kpa: kpa.slice(first) };
}

/** One loop a beat, each ending with the place at which the next begins; the last may be under way. */
export function beatsOf({ times_ms, ml, kpa }: Loop, periodMs: number): Loop[] {
  const beats: Loop[] = [];
  for (let from = 0; from < times_ms.length - 1; ) {
    const end = periodMs * (beats.length + 1) - 1e-6;
    const found = times_ms.findIndex((time) => time >= end);
    const to = found < 0 ? times_ms.length - 1 : found;
    beats.push({
      times_ms: times_ms.slice(from, to + 1),
      ml: ml.slice(from, to + 1),
      kpa: kpa.slice(from, to + 1),
    });
    from = to;
  }
  return beats;
}

/** Volume and pressure at a time, between those that were recorded; at the ends those. */
export function placeAt({ times_ms, ml, kpa }: Loop, timeMs: number): { ml: number; kpa: number } {
  const next = times_ms.findIndex((time) => time >= timeMs);
  if (next <= 0) {
    const end = next < 0 ? times_ms.length - 1 : 0;
    return { ml: ml[end], kpa: kpa[end] };
  }
  const part = (timeMs - times_ms[next - 1]) / (times_ms[next] - times_ms[next - 1]);
  const between = (values: number[]) => values[next - 1] + part * (values[next] - values[next - 1]);
  return { ml: between(ml), kpa: between(kpa) };
}

/** The time at which a loop comes nearest to a place, ml and kPa being so long on the screen. */
export function nearestTime(
  loop: Loop,
  at: { ml: number; kpa: number },
  scale: { ml: number; kpa: number },
): number {
  let nearest = 0;
  let least = Infinity;
  loop.times_ms.forEach((time, i) => {
    const distance = Math.hypot((loop.ml[i] - at.ml) * scale.ml, (loop.kpa[i] - at.kpa) * scale.kpa);
    if (distance < least) [nearest, least] = [time, distance];
  });
  return nearest;
}

/** Whole steps from below the least to above the most: ends and marks of an axis. */
export function axisMarks(least: number, most: number, about: number): number[] {
  const span = Math.max(most - least, 1e-6);
  const power = 10 ** Math.floor(Math.log10(span / about));
  const step = [1, 2, 5, 10].map((times) => times * power).find((one) => span / one <= about) ?? 10 * power;
  const first = Math.floor(least / step + 1e-9);
  const last = Math.max(first + 1, Math.ceil(most / step - 1e-9));
  return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

/** Everything that was recorded, a line for each time. */
export function tracesCsv({ times_ms, lines }: Traces): string {
  const head = ['time_ms', ...lines.map(({ name, unit }) => `${name}_${unit.replaceAll('/', '_per_')}`)];
  const rows = times_ms.map((time, i) =>
    [Number(time.toFixed(6)), ...lines.map(({ values }) => values[i])].join(','),
  );
  return `${[head.join(','), ...rows].join('\n')}\n`;
}

const mmhgPerKpa = 7.50062;

/** What a ventricle did in one beat: short names with units, what they stand for, numbers. */
export const figuresOf = (beat: VentricleBeat): [name: string, title: string, value: string][] => [
  ['EDV, ml', 'End-diastolic volume', beat.end_diastolic_ml.toFixed(1)],
  ['ESV, ml', 'End-systolic volume', beat.end_systolic_ml.toFixed(1)],
  ['SV, ml', 'Stroke volume', beat.stroke_ml.toFixed(1)],
  ['EF, %', 'Ejection fraction', (100 * beat.ejection_fraction).toFixed(1)],
  ['Peak, kPa', 'Highest pressure', beat.most_kpa.toFixed(2)],
  ['Peak, mmHg', 'Highest pressure', (mmhgPerKpa * beat.most_kpa).toFixed(0)],
  ['Work, J', 'Stroke work', beat.stroke_work_j.toFixed(3)],
];
