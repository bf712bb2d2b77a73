import type { Report } from '../engine/contract';
import { brush, focusTet, stageShown } from '../store/view';
import { NumberInput } from './fields';
import { whole } from './format';
import { HistogramChart, type Series } from './histogram';
import { Icon } from './icons';

/** The range that a histogram has selected, in numbers: the same control for the keyboard. */
function BrushRow({ metric, unit }: { metric: 'edge_mm' | 'dihedral_deg'; unit: string }) {
  const range = brush.value?.metric === metric ? brush.value : null;
  if (!range) return <p class="brush-hint">Drag across the bars to see those elements.</p>;
  const set = (lo: number, hi: number) => (brush.value = { ...range, lo, hi });
  const name = metric === 'edge_mm' ? 'mean edge' : 'angle';
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
        {unit}, {range.shown === null ? '…' : whole(range.shown)} elements
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

function startBrush(metric: 'edge_mm' | 'dihedral_deg') {
  return (lo: number, hi: number) => {
    focusTet.value = null;
    if (stageShown.value !== 'optimise') stageShown.value = 'quality';
    brush.value = { metric, lo, hi, shown: null };
  };
}

const selectEdges = startBrush('edge_mm');
const selectAngles = startBrush('dihedral_deg');
const angleRange: [number, number] = [0, 180];
const seriesCache = new WeakMap<Report, Record<'edges' | 'aspects' | 'angles', Series[]>>();

/** Series keep their identity for one report, so that charts are not rebuilt with every render. */
function seriesOf(found: Report) {
  const cached = seriesCache.get(found);
  if (cached) return cached;
  const one = (metric: string, name: string, tone: Series['tone']): Series[] => {
    const entry = found.quality.metrics.find((candidate) => candidate.name === metric);
    return entry && entry.histogram.counts.length > 0 ? [{ name, histogram: entry.histogram, tone }] : [];
  };
  const made = {
    edges: [...one('wished_edge_mm', 'Prescribed', 'before'), ...one('edge_mm', 'Achieved', 'now')],
    aspects: [
      ...one('triangle_aspect_before', 'Label surface', 'before'),
      ...one('triangle_aspect_after', 'Adapted surface', 'now'),
    ],
    angles: one('dihedral_deg', 'All six angles of each element', 'now'),
  };
  seriesCache.set(found, made);
  return made;
}

export function ElementHistograms({ found }: { found: Report }) {
  const { edges, aspects, angles } = seriesOf(found);
  const range = (metric: string): [number, number] | null =>
    brush.value?.metric === metric ? [brush.value.lo, brush.value.hi] : null;
  return (
    <section class="section histograms">
      {edges.length > 0 && (
        <>
          <HistogramChart
            title="Edge length"
            unit="mm"
            of="edges"
            series={edges}
            selected={range('edge_mm')}
            onSelect={selectEdges}
          />
          <BrushRow metric="edge_mm" unit="mm" />
        </>
      )}
      {aspects.length > 0 && (
        <HistogramChart title="Aspect ratio of surface triangles" unit="" of="triangles" series={aspects} />
      )}
      {angles.length > 0 && (
        <>
          <HistogramChart
            title="Dihedral angles"
            unit="degrees"
            of="angles"
            series={angles}
            range={angleRange}
            selected={range('dihedral_deg')}
            onSelect={selectAngles}
          />
          <BrushRow metric="dihedral_deg" unit="°" />
        </>
      )}
    </section>
  );
}
