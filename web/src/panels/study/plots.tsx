import { useMemo, useState } from 'preact/hooks';
import { histogramOf, isOutlying, usualRange } from '../../store/study/spread';
import type { Study, StudyRow } from '../../store/study/read_study';
import { SelectField } from '../controls/fields';
import { HistogramChart } from '../controls/histogram';
import { columnUnit, columnWords, numericOptions, withUnit } from './column_words';
import { ScatterChart } from './scatter_chart';

interface PlotProps {
  of: Study;
  selected: StudyRow | null;
  onSelect(row: StudyRow): void;
}

/** Names of outliers beyond so many are counted. */
const mostNamed = 8;

/** The wanted column where the study has it, else the first of its kind. */
function startingColumn(options: readonly [string, string][], wanted: string, place: number): string {
  const names = options.map(([name]) => name);
  return names.includes(wanted) ? wanted : (names[place] ?? names[0]);
}

/** How a column's values spread over the cases; the outliers by name. */
function Distribution({ of, selected, onSelect, name }: PlotProps & { name: string }) {
  const { rows, columns } = of;
  const chart = useMemo(() => {
    const cases = rows.flatMap((row) => {
      const value = row.values[name];
      return typeof value === 'number' ? [{ row, value }] : [];
    });
    const histogram = histogramOf(cases.map(({ value }) => value));
    return {
      cases,
      series: [{ name: columnWords(name), histogram, tone: 'now' as const }],
      range: [histogram.lo, histogram.hi] as [number, number],
    };
  }, [of, name]);
  const spread = columns.find((column) => column.name === name)?.spread;
  const outliers = spread ? chart.cases.filter(({ value }) => isOutlying(value, spread)) : [];
  const value = selected?.values[name];
  return (
    <>
      <HistogramChart
        title={columnWords(name)}
        unit={columnUnit(name)}
        of="cases"
        series={chart.series}
        range={chart.range}
        bins={chart.series[0].histogram.counts.length}
        band={spread ? usualRange(spread) : undefined}
        selected={typeof value === 'number' ? [value, value] : null}
      />
      {spread && (
        <p class="brush-hint">
          Median {withUnit(spread.median, name)}, half of the cases from {withUnit(spread.low, name)} to{' '}
          {withUnit(spread.high, name)}.{' '}
          {outliers.length === 0
            ? 'No case lies outside of the band.'
            : 'Farther out than three times their distance, outside of the band: '}
          {outliers.slice(0, mostNamed).map(({ row }, i) => (
            <span key={row.case}>
              {i > 0 && ', '}
              <button type="button" class="link-button" onClick={() => onSelect(row)}>
                {row.name}
              </button>
            </span>
          ))}
          {outliers.length > mostNamed && ` and ${outliers.length - mostNamed} more`}
          {outliers.length > 0 && '.'}
        </p>
      )}
    </>
  );
}

/** Two columns against each other, and the values of one. */
export function Plots(props: PlotProps & { onOpen(row: StudyRow): void }) {
  const { of } = props;
  const options = useMemo(() => numericOptions(of), [of]);
  const [x, setX] = useState(() => startingColumn(options, 'tets', 0));
  const [y, setY] = useState(() => startingColumn(options, 'smallest_dihedral_deg', 1));
  const [name, setName] = useState(y);
  return (
    <aside class="study-plots" aria-label="Plots">
      <section class="section">
        <h2>Scatter plot</h2>
        <SelectField label="X axis" value={x} options={options} onChange={setX} />
        <SelectField label="Y axis" value={y} options={options} onChange={setY} />
        <ScatterChart {...props} x={x} y={y} />
      </section>
      <section class="section">
        <h2>Histogram</h2>
        <SelectField label="Column" value={name} options={options} onChange={setName} />
        <Distribution {...props} name={name} />
      </section>
    </aside>
  );
}
