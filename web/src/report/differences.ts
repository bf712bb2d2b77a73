/** Two runs side by side, in numbers. */
import type { Recipe, Report } from '../engine/contract';

export interface Difference {
  name: string;
  unit: string;
  pinned: number;
  now: number;
  /** Which way is better; nothing where neither is. */
  better?: 'more' | 'less';
}

function metric(found: Report, name: string) {
  return found.quality.metrics.find((entry) => entry.name === name);
}

const seconds = (found: Report) => found.stages.reduce((sum, stage) => sum + stage.seconds, 0);
const worstVolume = ({ fidelity }: Report) =>
  fidelity && Math.max(0, ...fidelity.labels.map((row) => Math.abs(row.volume_error_percent)));
const worstDice = ({ fidelity }: Report) =>
  fidelity && Math.min(1, ...fidelity.labels.map((row) => row.dice));

const rows: {
  name: string;
  unit: string;
  of(found: Report): number | undefined;
  better?: 'more' | 'less';
}[] = [
  { name: 'Tetrahedra', unit: '', of: (found) => found.tets },
  { name: 'Points', unit: '', of: (found) => found.points },
  {
    name: 'Angle, smallest',
    unit: '°',
    of: (found) => metric(found, 'min_dihedral_deg')?.min,
    better: 'more',
  },
  {
    name: 'Angles, 1 %',
    unit: '°',
    of: (found) => metric(found, 'min_dihedral_deg')?.p1,
    better: 'more',
  },
  { name: 'Radius ratio', unit: '', of: (found) => metric(found, 'radius_ratio')?.mean, better: 'more' },
  { name: 'Edge, median', unit: 'mm', of: (found) => metric(found, 'edge_mm')?.median },
  { name: 'Size ratio', unit: 'log₂', of: (found) => metric(found, 'size_log2')?.median },
  { name: 'Volume error', unit: '%', of: worstVolume, better: 'less' },
  { name: 'Dice', unit: '', of: worstDice, better: 'more' },
  {
    name: 'Distance, 95 %',
    unit: 'mm',
    of: (found) => found.fidelity?.mesh_to_surface.p95_mm,
    better: 'less',
  },
  {
    name: 'Distance, largest',
    unit: 'mm',
    of: (found) => found.fidelity?.mesh_to_surface.max_mm,
    better: 'less',
  },
  { name: 'Time', unit: 's', of: seconds },
];

/** What both reports measured. */
export function differencesOf(pinned: Report, now: Report): Difference[] {
  return rows.flatMap(({ name, unit, of, better }) => {
    const [before, after] = [of(pinned), of(now)];
    return before === undefined || after === undefined
      ? []
      : [{ name, unit, pinned: before, now: after, better }];
  });
}

export interface FieldChange {
  path: string;
  pinned: string;
  now: string;
}

const plain = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

const things = (value: unknown): value is Record<string, unknown>[] =>
  Array.isArray(value) && value.every(plain);

/** Fields in which two recipes differ; lists as a whole, unless as many things of several fields stand in both. */
export function changedFields(pinned: Recipe, now: Recipe): FieldChange[] {
  const found: FieldChange[] = [];
  const text = (value: unknown) => (value === undefined ? 'none' : JSON.stringify(value).replaceAll('"', ''));
  const compare = (before: unknown, after: unknown, path: string) => {
    if (things(before) && things(after) && before.length === after.length) {
      before.forEach((one, i) => compare(one, after[i], `${path}.${i + 1}`));
    } else if (plain(before) && plain(after)) {
      for (const name of new Set([...Object.keys(before), ...Object.keys(after)]))
        compare(before[name], after[name], path ? `${path}.${name}` : name);
    } else if (JSON.stringify(before) !== JSON.stringify(after)) {
      found.push({ path, pinned: text(before), now: text(after) });
    }
  };
  compare(pinned, now, '');
  return found;
}
