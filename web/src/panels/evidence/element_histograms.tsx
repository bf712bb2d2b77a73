import { useState } from 'preact/hooks';
import type { Report } from '../../engine/contract';
import { coveringRange, shareWithin } from '../../geometry/histogram';
import { evenFactor, seriesOf, shapeMeasures, type ChartKind, type Series } from '../../report/charts';
import { brush, focusTet, stageShown, type Brush } from '../../store/view';
import { NumberInput } from '../controls/fields';
import { sentence, short, whole } from '../controls/format';
import { HistogramChart } from '../controls/histogram';
import { Icon } from '../controls/icons';

type BrushMetric = Brush['metric'];

/** The range that a histogram has selected, in numbers: the same control for the keyboard. */
function BrushRow(props: { metric: BrushMetric; name: string; unit: string; series: Series[] }) {
  const { metric, name, unit, series } = props;
  const range = brush.value?.metric === metric ? brush.value : null;
  if (!range) {
    return (
      <p class="brush-hint">
        Drag across the bars to see those elements, or{' '}
        <button
          type="button"
          class="link-button"
          onClick={() => startBrush(metric, ...coveringRange(series.map(({ histogram }) => histogram)))}
        >
          give a range
          <span class="sr"> of {name}</span>
        </button>
        .
      </p>
    );
  }
  const set = (lo: number, hi: number) => (brush.value = { ...range, lo, hi });
  return (
    <div class="brush-row">
      <NumberInput
        label={`Smallest ${name}`}
        value={Number(range.lo.toFixed(2))}
        onChange={(lo) => lo !== null && set(lo, range.hi)}
      />
      <span>to</span>
      <NumberInput
        label={`Largest ${name}`}
        value={Number(range.hi.toFixed(2))}
        onChange={(hi) => hi !== null && set(range.lo, hi)}
      />
      <span class="brush-count" data-testid="brush-count">
        {unit && `${unit}, `}
        {range.shown === null ? '…' : whole(range.shown)} elements
      </span>
      <button
        type="button"
        class="icon-button small"
        aria-label="Show all elements"
        title="Show all"
        onClick={() => (brush.value = null)}
      >
        <Icon name="cross" size={13} />
      </button>
    </div>
  );
}

function startBrush(metric: BrushMetric, lo: number, hi: number): void {
  focusTet.value = null;
  if (stageShown.value !== 'optimise') stageShown.value = 'quality';
  brush.value = { metric, lo, hi, shown: null };
}

interface Chart {
  kind: ChartKind;
  title: string;
  of: string;
  unit: string;
  range?: [number, number];
  /** What is good, and how it is said of the share that is in it. */
  band?: { range: [number, number]; words: string };
  tick?(value: number): string;
  /** What a dragged range chooses elements by. */
  brushed?: { metric: BrushMetric; name: string; unit: string };
}

const charts: Chart[] = [
  {
    kind: 'edges',
    title: 'Edge length',
    of: 'edges',
    unit: 'mm',
    brushed: { metric: 'edge_mm', name: 'mean edge', unit: 'mm' },
  },
  {
    kind: 'ratios',
    title: 'Edge length / target edge length',
    of: 'edges',
    unit: '',
    band: {
      range: [-Math.log2(evenFactor), Math.log2(evenFactor)],
      words: 'of all edges have 0.71 to 1.41 times their target',
    },
    tick: (log2) => short(2 ** log2),
    brushed: { metric: 'size_log2', name: 'size ratio', unit: 'log₂' },
  },
  { kind: 'aspects', title: 'Aspect ratio of surface triangles', of: 'triangles', unit: '' },
  {
    kind: 'angles',
    title: 'Dihedral angles',
    of: 'angles',
    unit: 'degrees',
    range: [0, 180],
    brushed: { metric: 'dihedral_deg', name: 'angle', unit: '°' },
  },
];

const shape = (kind: string, title: string): Chart => ({
  kind,
  title,
  of: 'tetrahedra',
  unit: '',
  brushed: { metric: kind, name: title.toLowerCase(), unit: '' },
});

/** Charts keep what they do for a metric, so that they are not rebuilt with every render. */
const brushing = new Map<BrushMetric, (lo: number, hi: number) => void>();

function brushOf(metric: BrushMetric): (lo: number, hi: number) => void {
  let start = brushing.get(metric);
  if (!start) brushing.set(metric, (start = (lo, hi) => startBrush(metric, lo, hi)));
  return start;
}

function ChartOf({ chart, found, pinned }: { chart: Chart; found: Report; pinned: Report | null }) {
  const series = seriesOf(found, pinned)[chart.kind];
  if (series.length === 0) return null;
  const { brushed } = chart;
  const selected = brushed && brush.value?.metric === brushed.metric ? brush.value : null;
  return (
    <>
      <HistogramChart
        title={chart.title}
        unit={chart.unit}
        of={chart.of}
        series={series}
        range={chart.range}
        band={chart.band?.range}
        tick={chart.tick}
        selected={selected && [selected.lo, selected.hi]}
        onSelect={brushed && brushOf(brushed.metric)}
      />
      {chart.band && (
        <p class="brush-hint">
          {(100 * shareWithin(series[series.length - 1].histogram, ...chart.band.range)).toFixed(1)} %{' '}
          {chart.band.words}.
        </p>
      )}
      {brushed && <BrushRow {...brushed} series={series} />}
    </>
  );
}

export function ElementHistograms({ found, pinned }: { found: Report; pinned: Report | null }) {
  const [open, setOpen] = useState(false);
  const row = (chart: Chart) => <ChartOf key={chart.kind} chart={chart} found={found} pinned={pinned} />;
  return (
    <section class="section histograms">
      {charts.map(row)}
      <details class="more" open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
        <summary>Shape of the tetrahedra</summary>
        {open && shapeMeasures(found).map(({ name, title }) => row(shape(name, title || sentence(name))))}
      </details>
    </section>
  );
}
