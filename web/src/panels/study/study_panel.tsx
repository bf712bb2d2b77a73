/** The results of a study: a table of its cases, plots, and the case that is selected. */
import { useMemo, useState } from 'preact/hooks';
import { openFragment } from '../../store/case/open_case';
import { hasSource, recipe } from '../../store/case/recipe';
import {
  filterCounts,
  passes,
  sorted,
  summaryOf,
  type RowFilter,
  type RowOrder,
} from '../../store/study/rows';
import { closeStudy, study, studyShown, type OpenStudy } from '../../store/study/study';
import type { StudyRow } from '../../store/study/read_study';
import { Segments } from '../controls/fields';
import { seconds, short, whole } from '../controls/format';
import { Icon } from '../controls/icons';
import { tabbed } from '../controls/page_shape';
import { CaseCard } from './case_card';
import { ColumnMenu } from './column_menu';
import { startingColumns } from './column_words';
import { Plots } from './plots';
import { StudyTable } from './study_table';

const filterNames: Record<RowFilter, string> = {
  all: 'All',
  done: 'Done',
  failed: 'Failed',
  missing: 'Missing',
  outliers: 'Outliers',
};

/** What all cases took together, and the most memory of one; nothing without costs. */
function costWords({ rows }: OpenStudy): string {
  const of = (name: string) =>
    rows.flatMap(({ values }) => (typeof values[name] === 'number' ? [values[name]] : []));
  const [times, peaks] = [of('seconds'), of('peak_mb')];
  const parts = [
    ...(times.length > 0 ? [`${seconds(times.reduce((sum, time) => sum + time, 0))} in all`] : []),
    ...(peaks.length > 0 ? [`at most ${short(Math.max(...peaks))} MB a case`] : []),
  ];
  return parts.join(', ');
}

function open({ link }: StudyRow): void {
  if (link) void openFragment(link);
}

function StudyPanel({ of }: { of: OpenStudy }) {
  const [filter, setFilter] = useState<RowFilter>('all');
  const [order, setOrder] = useState<RowOrder>({ column: 'case', descending: false });
  const [shown, setShown] = useState(() => startingColumns(of));
  const [selected, select] = useState<StudyRow | null>(null);
  const [part, setPart] = useState<'table' | 'plots'>('table');
  const rows = useMemo(
    () =>
      sorted(
        of.rows.filter((row) => passes(row, filter)),
        order,
      ),
    [of, filter, order],
  );
  const columns = useMemo(() => of.columns.filter(({ name }) => shown.has(name)), [of, shown]);
  return (
    <section class="study" aria-label="Study" data-part={tabbed.value ? part : undefined}>
      <div class="study-head">
        <h1>{summaryOf(of)}</h1>
        <p>{costWords(of)}</p>
        <span class="spacer" />
        {recipe.value && hasSource(recipe.value) && (
          <button type="button" class="button small" onClick={() => (studyShown.value = false)}>
            Back to the case
          </button>
        )}
        <button
          type="button"
          class="icon-button small"
          aria-label="Close the study"
          title="Close the study"
          onClick={closeStudy}
        >
          <Icon name="cross" size={14} />
        </button>
      </div>
      <div class="study-tools">
        {tabbed.value && (
          <Segments
            label="Part of the study"
            value={part}
            options={[
              ['table', 'Table'],
              ['plots', 'Plots'],
            ]}
            onChange={(next) => setPart(next)}
          />
        )}
        <Segments
          label="Cases shown"
          value={filter}
          options={filterCounts(of).map(([name, count]) => [name, `${filterNames[name]} ${whole(count)}`])}
          onChange={(next) => setFilter(next)}
        />
        <ColumnMenu of={of} shown={shown} onChange={setShown} />
      </div>
      <StudyTable
        of={of}
        rows={rows}
        columns={columns}
        order={order}
        onOrder={setOrder}
        selected={selected}
        onSelect={select}
        onOpen={open}
      />
      <CaseCard of={of} row={selected} onOpen={open} />
      <Plots of={of} selected={selected} onSelect={select} onOpen={open} />
    </section>
  );
}

/** The study that is open. */
export function StudyResults() {
  return study.value && <StudyPanel key={study.value.id} of={study.value} />;
}
