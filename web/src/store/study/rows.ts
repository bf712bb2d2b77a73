/** Rows of a study: chosen, sorted, summed up in words. */
import { statuses, type Status, type Study, type StudyRow, type Value } from './read_study';

/** Which rows are shown: of one status, or those with a value that is an outlier. */
export type RowFilter = 'all' | Status | 'outliers';

export interface RowOrder {
  column: string;
  descending: boolean;
}

export function passes(row: StudyRow, filter: RowFilter): boolean {
  if (filter === 'outliers') return row.outlying.length > 0;
  return filter === 'all' || row.status === filter;
}

/** How many rows each filter leaves; those that leave none are left out. */
export function filterCounts({ rows }: Study): [RowFilter, number][] {
  const filters: RowFilter[] = ['all', ...statuses, 'outliers'];
  return filters
    .map((filter): [RowFilter, number] => [filter, rows.filter((row) => passes(row, filter)).length])
    .filter(([, count]) => count > 0);
}

/** As a reader counts: "heart 9" stands before "heart 10". */
const collator = new Intl.Collator('en', { numeric: true });

function compare(a: Value, b: Value): number {
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return collator.compare(String(a), String(b));
}

/** Rows without a value stand last either way; equal ones as they stand in the study. */
export function sorted(rows: readonly StudyRow[], { column, descending }: RowOrder): StudyRow[] {
  const sign = descending ? -1 : 1;
  return [...rows].sort((one, other) => {
    const [a, b] = [one.values[column], other.values[column]];
    if (a === null || b === null) return Number(a === null) - Number(b === null);
    return sign * compare(a, b);
  });
}

/** "100 cases: 98 done, 2 failed". */
export function summaryOf(study: Study): string {
  const { length } = study.rows;
  const parts = filterCounts(study)
    .filter(([filter]) => filter !== 'all' && filter !== 'outliers')
    .map(([status, count]) => `${count.toLocaleString('en')} ${status}`);
  return `${length.toLocaleString('en')} ${length === 1 ? 'case' : 'cases'}: ${parts.join(', ')}`;
}
