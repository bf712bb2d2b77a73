import type { RefObject } from 'preact';
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Study, StudyColumn, StudyRow } from '../../store/study/read_study';
import type { RowOrder } from '../../store/study/rows';
import { Icon } from '../controls/icons';
import { cellText, columnTitle, columnUnit, columnWords } from './column_words';
import { StatusMark } from './status_mark';

interface StudyTableProps {
  of: Study;
  /** Those of the study that are shown, in their order. */
  rows: readonly StudyRow[];
  columns: readonly StudyColumn[];
  order: RowOrder;
  onOrder(order: RowOrder): void;
  selected: StudyRow | null;
  onSelect(row: StudyRow): void;
  onOpen(row: StudyRow): void;
}

/** Rows that are drawn above and below those in sight. */
const spare = 12;

interface Sight {
  first: number;
  count: number;
}

/** Where rows lie in what scrolls: all are of one height. */
function measure(scroller: HTMLElement, count: number) {
  const head = scroller.querySelector('thead')?.offsetHeight ?? 0;
  return { head, height: (scroller.scrollHeight - head) / Math.max(count, 1) };
}

/** Which rows are in sight, of so many. */
function useSight(scroller: RefObject<HTMLElement | null>, count: number): Sight {
  const [sight, setSight] = useState<Sight>({ first: 0, count: 40 });
  useLayoutEffect(() => {
    const element = scroller.current;
    if (!element) return;
    const look = () => {
      const { height } = measure(element, count);
      const first = Math.max(0, Math.floor(element.scrollTop / height) - spare);
      const inSight = Math.ceil(element.clientHeight / height) + 2 * spare;
      setSight((old) => (old.first === first && old.count === inSight ? old : { first, count: inSight }));
    };
    look();
    const observer = new ResizeObserver(look);
    observer.observe(element);
    element.addEventListener('scroll', look, { passive: true });
    return () => {
      observer.disconnect();
      element.removeEventListener('scroll', look);
    };
  }, [count]);
  return sight;
}

/** As wide as its longest value and the words of its head, in characters. */
function widthOf(head: string, texts: Iterable<string>): string {
  let most = Math.max(...head.split(' ').map(({ length }) => length), Math.ceil(head.length / 2)) + 2;
  for (const { length } of texts) most = Math.max(most, length);
  return `calc(${Math.min(most, 26)}ch + 20px)`;
}

function Head(props: {
  name: string;
  words: string;
  unit?: string;
  numeric?: boolean;
  order: RowOrder;
  onOrder(order: RowOrder): void;
}) {
  const { name, words, unit, numeric, order, onOrder } = props;
  const sorts = order.column === name;
  const way = order.descending ? 'descending' : 'ascending';
  return (
    <th scope="col" class={numeric ? 'num' : ''} aria-sort={sorts ? way : 'none'}>
      <button
        type="button"
        title={`Sort by ${words.toLowerCase()}`}
        onClick={() => onOrder({ column: name, descending: sorts && !order.descending })}
      >
        <span>
          {words}
          {unit && <span class="unit"> {unit}</span>}
        </span>
        {sorts && <Icon name={order.descending ? 'down' : 'up'} size={11} />}
      </button>
    </th>
  );
}

/** Columns of a row that has no figures hold, as one cell, why. */
function blankSpan(row: StudyRow, columns: readonly StudyColumn[]): [from: number, length: number] {
  const isBlank = ({ name, kind }: StudyColumn) => kind !== 'given' && row.values[name] === null;
  const from = row.status === 'done' ? -1 : columns.findIndex(isBlank);
  if (from < 0) return [columns.length, 0];
  const filled = columns.findIndex((column, i) => i > from && !isBlank(column));
  return [from, (filled < 0 ? columns.length : filled) - from];
}

function whyBlank({ status, stage, reason }: StudyRow): string {
  if (status === 'missing') return 'not run yet';
  return [stage, reason].filter(Boolean).join(': ');
}

function Cell({ row, column }: { row: StudyRow; column: StudyColumn }) {
  const { name, numeric } = column;
  const value = row.values[name];
  const outlying = row.outlying.includes(name);
  return (
    <td
      class={`${numeric ? 'num' : ''} ${outlying ? 'outlying' : ''}`}
      title={outlying ? `${value}, an outlier` : value === null ? undefined : String(value)}
    >
      {outlying && <span class="sr">outlier </span>}
      {cellText(column, value)}
    </td>
  );
}

function Row(props: {
  row: StudyRow;
  index: number;
  columns: readonly StudyColumn[];
  selected: boolean;
  onSelect(row: StudyRow): void;
  onOpen(row: StudyRow): void;
}) {
  const { row, index, columns, selected, onSelect, onOpen } = props;
  const [from, length] = blankSpan(row, columns);
  const why = length > 0 ? whyBlank(row) : '';
  return (
    <tr
      id={`study-case-${row.case}`}
      class={row.status}
      aria-rowindex={index + 2}
      aria-selected={selected}
      onClick={() => onSelect(row)}
      onDblClick={() => onOpen(row)}
    >
      <th scope="row" title={row.name}>
        {row.name}
      </th>
      <td>
        <StatusMark status={row.status} />
      </td>
      {columns.slice(0, from).map((column) => (
        <Cell key={column.name} row={row} column={column} />
      ))}
      {length > 0 && (
        <td class="study-why" colSpan={length} title={why}>
          {why}
        </td>
      )}
      {columns.slice(from + length).map((column) => (
        <Cell key={column.name} row={row} column={column} />
      ))}
    </tr>
  );
}

/** The room of rows that are not drawn. */
function Space({ rows }: { rows: number }) {
  return (
    <tbody aria-hidden="true">
      <tr style={{ height: `calc(${rows} * var(--row))` }} />
    </tbody>
  );
}

/** The cases as a grid: a press on a head sorts, arrow keys select, Enter opens. Only rows in sight are drawn. */
export function StudyTable(props: StudyTableProps) {
  const { of, rows, columns, order, onOrder, selected, onSelect, onOpen } = props;
  const scroller = useRef<HTMLDivElement>(null);
  const { first, count } = useSight(scroller, rows.length);
  const inSight = rows.slice(first, first + count);
  const after = Math.max(0, rows.length - first - inSight.length);
  const at = selected ? rows.indexOf(selected) : -1;
  const widths = useMemo(() => {
    const textsOf = (column: StudyColumn) =>
      of.rows.map(({ values }) => cellText(column, values[column.name]));
    return columns.map((column) => widthOf(columnTitle(column.name), textsOf(column)));
  }, [of, columns]);
  const nameWidth = useMemo(
    () =>
      widthOf(
        'Name',
        of.rows.map(({ name }) => name),
      ),
    [of],
  );
  useEffect(() => {
    const element = scroller.current;
    if (!element || at < 0) return;
    const { head, height } = measure(element, rows.length);
    const inView = element.clientHeight - head - height;
    const top = at * height;
    if (top < element.scrollTop) element.scrollTop = top;
    else if (top > element.scrollTop + inView) element.scrollTop = top - inView;
  }, [at]);
  const onKey = (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget || rows.length === 0) return;
    const page = Math.max(1, count - 2 * spare - 2);
    const last = rows.length - 1;
    const next = {
      ArrowDown: at + 1,
      ArrowUp: at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: last,
    }[event.key];
    if (next !== undefined) onSelect(rows[Math.max(0, Math.min(last, next))]);
    else if (event.key === 'Enter' && selected) onOpen(selected);
    else return;
    event.preventDefault();
  };
  return (
    <div class="study-table" ref={scroller}>
      <table
        // biome-ignore lint/a11y/noNoninteractiveElementToInteractiveRole: Its rows are selected by keys.
        role="grid"
        aria-label="Cases of the study"
        aria-rowcount={rows.length + 1}
        aria-activedescendant={
          at >= first && at < first + inSight.length ? `study-case-${selected?.case}` : undefined
        }
        tabIndex={0}
        onKeyDown={onKey}
      >
        <colgroup>
          <col style={{ width: nameWidth }} />
          <col class="study-status-column" />
          {columns.map(({ name }, i) => (
            <col key={name} style={{ width: widths[i] }} />
          ))}
        </colgroup>
        <thead>
          <tr aria-rowindex={1}>
            <Head name="name" words="Name" order={order} onOrder={onOrder} />
            <Head name="status" words="Status" order={order} onOrder={onOrder} />
            {columns.map(({ name, numeric }) => (
              <Head
                key={name}
                name={name}
                words={columnWords(name)}
                unit={columnUnit(name)}
                numeric={numeric}
                order={order}
                onOrder={onOrder}
              />
            ))}
          </tr>
        </thead>
        <Space rows={first} />
        <tbody>
          {inSight.map((row, i) => (
            <Row
              key={row.case}
              row={row}
              index={first + i}
              columns={columns}
              selected={row === selected}
              onSelect={onSelect}
              onOpen={onOpen}
            />
          ))}
        </tbody>
        <Space rows={after} />
      </table>
    </div>
  );
}
