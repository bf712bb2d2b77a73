/** Columns of a study in words, their values as text, and which of them are shown at first. */
import type { Study, StudyColumn, Value } from '../../store/study/read_study';
import { pathWords } from '../controls/field_words';
import { sentence, short } from '../controls/format';

const words: Record<string, string> = {
  case: 'Number',
  change: 'Change',
  tets: 'Tetrahedra',
  smallest_dihedral_deg: 'Smallest dihedral angle',
  largest_dihedral_deg: 'Largest dihedral angle',
  passed: 'Checks passed',
  least_dice: 'Least Dice',
  eikonal_activated: 'Eikonal: activated',
  eikonal_last_ms: 'Eikonal: last activation',
  monodomain_activated: 'Monodomain: activated',
  monodomain_last_ms: 'Monodomain: last activation',
  lv_ejection_fraction: 'LV ejection fraction',
  rv_ejection_fraction: 'RV ejection fraction',
  seconds: 'Time',
  peak_mb: 'Peak memory',
  forecast_seconds: 'Forecast time',
  forecast_mb: 'Forecast memory',
};

const units: Record<string, string> = {
  deg: '°',
  mm: 'mm',
  ms: 'ms',
  percent: '%',
  mb: 'MB',
  seconds: 's',
};
const unitSuffix = /(?:^|_)(deg|mm|ms|percent|mb|seconds)$/;

export const columnUnit = (name: string): string => units[unitSuffix.exec(name)?.[1] ?? ''] ?? '';

export function columnWords(name: string): string {
  if (Object.hasOwn(words, name)) return words[name];
  return name.includes('.') ? pathWords(name).name : sentence(name.replace(unitSuffix, ''));
}

/** With its unit, as a chart's axis has it. */
export function columnTitle(name: string): string {
  const unit = columnUnit(name);
  return unit ? `${columnWords(name)}, ${unit}` : columnWords(name);
}

/** A value among those of its column: their decimals stand below each other. */
export function cellText({ decimals }: StudyColumn, value: Value): string {
  if (value === null) return '–';
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value === 'number')
    return value
      .toLocaleString('en', { minimumFractionDigits: decimals, maximumFractionDigits: decimals })
      .replace('-', '−');
  return /^[\da-f]{64}$/.test(value) ? `${value.slice(0, 10)}…` : value;
}

/** A number of a column as it stands alone, with its unit. */
export function withUnit(value: Value, name: string): string {
  const unit = columnUnit(name);
  const text = typeof value === 'number' ? short(value) : '–';
  return unit === '°' || !unit ? `${text}${unit}` : `${text} ${unit}`;
}

const mainFigures = new Set([
  ...['tets', 'smallest_dihedral_deg', 'median_mean_ratio', 'mean_distance_mm', 'worst_volume_error_percent'],
  ...['passed', 'eikonal_last_ms', 'monodomain_last_ms', 'lv_ejection_fraction', 'seconds', 'peak_mb'],
]);

const mostGiven = 4;

/** What differs between the cases, and the main figures. */
export function startingColumns({ columns }: Study): ReadonlySet<string> {
  // Of a cohort so much is drawn that its figures would be out of sight.
  const given = columns.filter(({ name, kind }) => kind === 'given' && name !== 'case').slice(0, mostGiven);
  const figures = columns.filter(({ name, kind }) => kind !== 'given' && mainFigures.has(name));
  return new Set([...given, ...figures].map(({ name }) => name));
}

/** Columns of numbers as the options of a select. */
export const numericOptions = ({ columns }: Study): [string, string][] =>
  columns.filter(({ numeric }) => numeric).map(({ name }) => [name, columnTitle(name)]);
