import type { Study, StudyRow } from '../../store/study/read_study';
import { Icon } from '../controls/icons';
import { columnWords, withUnit } from './column_words';
import { StatusMark } from './status_mark';

/** How far a value lies from those of the other cases. */
function outlierWords(row: StudyRow, { columns }: Study, name: string): string {
  const spread = columns.find((column) => column.name === name)?.spread;
  const value = row.values[name];
  if (!spread || typeof value !== 'number') return '';
  const side = value < spread.median ? 'below' : 'above';
  return `${columnWords(name)} ${withUnit(value, name)}, far ${side} the median ${withUnit(spread.median, name)}`;
}

/** The case that is selected: what came of it, and the way to it. */
export function CaseCard(props: { of: Study; row: StudyRow | null; onOpen(row: StudyRow): void }) {
  const { of, row, onOpen } = props;
  if (!row)
    return (
      <section class="study-case" aria-label="Selected case">
        <p class="muted">Select a case in the table or in a plot, then open it here.</p>
      </section>
    );
  return (
    <section class="study-case" aria-label="Selected case">
      <div class="study-case-text">
        <h2>
          {row.name} <StatusMark status={row.status} />
        </h2>
        {row.status === 'failed' && (
          <p class="study-reason">
            {row.stage && <strong>{row.stage}: </strong>}
            {row.reason}
          </p>
        )}
        {row.outlying.length > 0 && (
          <ul class="study-outliers">
            {row.outlying.map((name) => (
              <li key={name}>{outlierWords(row, of, name)}</li>
            ))}
          </ul>
        )}
      </div>
      <button
        type="button"
        class="button primary"
        disabled={row.link === null}
        title={
          row.link === null ? 'The study has no link of this case' : 'Enter, or a double click on its row'
        }
        onClick={() => onOpen(row)}
      >
        <Icon name="share" /> Open this case
      </button>
    </section>
  );
}
