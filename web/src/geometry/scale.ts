/** Scales of colours: their ends, ticks and boxes, for whoever draws them. */
import { colourTable, hexOf, type ColourMapName } from './colours';

export interface Legend {
  title: string;
  unit: string;
  lo: number;
  hi: number;
  map: ColourMapName;
  /** Least and largest of the values, which may lie beyond the ends. */
  values?: readonly [number, number];
  /** How many values there are in equal bins from end to end; those beyond it are in the first and the last. */
  counts?: readonly number[];
  /** Of few whole numbers. */
  whole?: boolean;
  /** Words beside the scale in place of numbers, from its lower end in even steps. */
  words?: readonly string[];
  /** Colours change at multiples of this, with a line: isochrones. */
  bands?: number;
}

/** The smallest of 1, 2, 5 and 10 times a power of ten that is no less than a number. */
export function roundStep(about: number): number {
  const power = 10 ** Math.floor(Math.log10(about));
  return power * ([1, 2, 5].find((step) => step * power >= about * 0.999) ?? 10);
}

/** Ends in round numbers that hold a range, each moved by less than a tenth of its length. */
export function endsAround([least, most]: readonly [number, number]): { lo: number; hi: number } {
  if (!(most > least)) return { lo: least - 0.5, hi: least + 0.5 };
  const step = roundStep((most - least) / 20);
  return {
    lo: Number((step * Math.floor(least / step + 1e-6)).toPrecision(12)),
    hi: Number((step * Math.ceil(most / step - 1e-6)).toPrecision(12)),
  };
}

/** Values beyond an end of the scale have the colour of that end. */
export const clipped = ({ lo, hi, values: [least, most] = [lo, hi] }: Legend) => {
  const slight = 1e-5 * (hi - lo);
  return { below: least < lo - slight, above: most > hi + slight };
};

function numberText(value: number, step: number): string {
  const digits = Math.max(0, Math.min(8, Math.ceil(-Math.log10(step) - 1e-6)));
  return value
    .toLocaleString('en', { minimumFractionDigits: digits, maximumFractionDigits: digits })
    .replace('-', '−');
}

/** The distance of ticks, of which there are at most about eight. */
function tickStep({ lo, hi, bands, whole }: Legend): number {
  if (bands) return bands * Math.ceil((hi - lo) / bands / 6);
  const step = roundStep((hi - lo || 1) / 8);
  return whole ? Math.max(1, step) : step;
}

/** Where what stands beside a scale stands: 0 is its lower end, 1 its upper one. */
export function ticksOf(legend: Legend): { at: number; text: string }[] {
  const { lo, hi, words } = legend;
  if (words) return words.map((text, i) => ({ at: (i + 0.5) / words.length, text }));
  const step = tickStep(legend);
  const boxes = wholeBoxes(legend);
  const first = Math.ceil(lo / step - 1e-6);
  const last = Math.floor(hi / step + 1e-6);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => {
    const value = (first + i) * step || 0; // never -0
    return {
      at: boxes > 0 ? (value - lo + 0.5) / boxes : (value - lo) / (hi - lo),
      text: numberText(value, step),
    };
  });
}

/** Of few whole numbers each has a box of its own: how many, or 0. */
function wholeBoxes({ lo, hi, whole }: Legend): number {
  return whole && hi - lo < 12 ? hi - lo + 1 : 0;
}

/** Where colours change in steps: from where to where, and which; none where they change evenly. */
export function boxesOf(legend: Legend): { from: number; to: number; colour: string }[] {
  const { lo, hi, map, bands } = legend;
  const table = colourTable(map);
  const colourAt = (t: number) => {
    const at = 3 * Math.round(255 * Math.max(0, Math.min(1, t)));
    return hexOf([table[at], table[at + 1], table[at + 2]]);
  };
  const whole = wholeBoxes(legend);
  const count = bands ? Math.round((hi - lo) / bands) : whole;
  return Array.from({ length: count }, (_, i) => ({
    from: i / count,
    to: (i + 1) / count,
    colour: colourAt(whole && !bands ? (whole > 1 ? i / (whole - 1) : 0) : (i + 0.5) / count),
  }));
}

const bins = 48;

/** A legend with what there is of values between and beyond its ends. */
export function withCounts(
  legend: Legend,
  values: ArrayLike<number>,
  counts: (value: number) => boolean = Number.isFinite,
): Legend {
  const { lo, hi } = legend;
  const columns = wholeBoxes(legend) || bins;
  const found = new Array<number>(columns).fill(0);
  const span = wholeBoxes(legend) ? columns : hi - lo;
  let [least, most] = [Infinity, -Infinity];
  for (let i = 0; i < values.length; i++) {
    const value = values[i];
    if (!counts(value)) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
    found[Math.max(0, Math.min(columns - 1, Math.floor((columns * (value - lo)) / span)))]++;
  }
  return least <= most ? { ...legend, values: [least, most], counts: found } : legend;
}
