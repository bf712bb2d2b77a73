import type { ChecklistItem, Metric, Report } from '../engine/contract';
import { tetMeasures, type TetMeasure } from '../engine/contract';
import { volume } from '../store/input';
import { expectation, report, upToDate, verdict } from '../store/run';
import { brush, colourOf, focusTet, stageShown } from '../store/view';
import { short, unitSign, whole } from './format';
import { HistogramChart, type Series } from './histogram';
import { Icon } from './icons';
import { NumberInput } from './fields';

const sentence = (name: string) =>
  (name.charAt(0).toUpperCase() + name.slice(1)).replace(/_(deg|mm)$/, '').replaceAll('_', ' ');

function VerdictCard() {
  const found = verdict.value;
  const promise = expectation.value;
  if (!promise) return null;
  if (!found) {
    return (
      <section class="verdict pending" role="status">
        <h2>This link promises a mesh</h2>
        <p>
          {whole(promise.expected.tets)} tetrahedra, made with voxtet {promise.expected.engine}.{' '}
          {report.value
            ? 'The settings were changed since; undo to compare.'
            : 'Run to see whether it is reproduced.'}
        </p>
      </section>
    );
  }
  const titles = {
    reproduced: 'Reproduced, byte for byte',
    differs: 'Differs from what the link promises',
    other_engine: 'Made with another engine',
  };
  return (
    <section class={`verdict ${found.kind}`} role="status" data-testid="verdict">
      <h2>
        <Icon name={found.kind === 'reproduced' ? 'check' : 'warn'} /> {titles[found.kind]}
      </h2>
      <table>
        <thead>
          <tr>
            <th scope="col">
              <span class="sr">What</span>
            </th>
            <th scope="col">Link</th>
            <th scope="col">This run</th>
          </tr>
        </thead>
        <tbody>
          {found.rows.map((row) => (
            <tr key={row.name} class={row.same ? '' : 'other'}>
              <th scope="row">{row.name}</th>
              <td title={row.expected}>
                {row.expected.length > 20 ? `${row.expected.slice(0, 10)}…` : row.expected}
              </td>
              <td title={row.found}>{row.found.length > 20 ? `${row.found.slice(0, 10)}…` : row.found}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

function Summary({ found }: { found: Report }) {
  const angles = found.quality.metrics.find((metric) => metric.name === 'min_dihedral_deg');
  return (
    <section class="section summary">
      <dl>
        <div>
          <dt>Tetrahedra</dt>
          <dd data-testid="tets">{whole(found.tets)}</dd>
        </div>
        <div>
          <dt>Points</dt>
          <dd>{whole(found.points)}</dd>
        </div>
        {angles && (
          <div>
            <dt>Smallest angle</dt>
            <dd>{short(angles.min)}°</dd>
          </div>
        )}
      </dl>
      {!upToDate.value && (
        <p class="stale">The recipe has changed since this mesh was made. Run to bring it up to date.</p>
      )}
    </section>
  );
}

function CheckRow({ item }: { item: ChecklistItem }) {
  const tone = item.passed ? 'pass' : item.hard ? 'fail' : 'caution';
  return (
    <li class={tone}>
      <Icon name={item.passed ? 'check' : item.hard ? 'cross' : 'warn'} size={14} />
      <span class="check-name">{sentence(item.name)}</span>
      <span class="check-found" title={`Expected ${item.expected}`}>
        {item.found}
      </span>
      <span class="sr">
        {item.passed ? 'passed' : 'not passed'}, expected {item.expected}
      </span>
    </li>
  );
}

function Checklist({ found }: { found: Report }) {
  const { checklist } = found.quality;
  const failed = checklist.filter((item) => !item.passed).length;
  const rows = (passed: boolean) =>
    checklist
      .filter((item) => item.passed === passed)
      .map((item) => <CheckRow key={item.name} item={item} />);
  return (
    <section class="section">
      <h2>
        Checklist{' '}
        <span class={failed === 0 ? 'tag pass' : found.quality.passed ? 'tag caution' : 'tag fail'}>
          {failed === 0 ? 'all passed' : `${failed} of ${checklist.length} not passed`}
        </span>
      </h2>
      <ul class="checklist">{rows(false)}</ul>
      {failed < checklist.length && (
        <details class="more">
          <summary>{checklist.length - failed} passed</summary>
          <ul class="checklist">{rows(true)}</ul>
        </details>
      )}
    </section>
  );
}

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
    if (stageShown.value !== 'tetra') stageShown.value = 'quality';
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

function Histograms({ found }: { found: Report }) {
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

function WorstButton({ metric }: { metric: Metric }) {
  const isTetMeasure = metric.elements === 'tets' && (tetMeasures as readonly string[]).includes(metric.name);
  if (!isTetMeasure || metric.worst.length === 0) return null;
  const fly = () => {
    if (stageShown.value !== 'tetra') stageShown.value = 'quality';
    const at = focusTet.value === null ? -1 : metric.worst.indexOf(focusTet.value);
    brush.value = null;
    focusTet.value = metric.worst[(at + 1) % metric.worst.length];
  };
  return (
    <button
      type="button"
      class="icon-button small"
      aria-label={`Fly to the worst element by ${sentence(metric.name as TetMeasure)}`}
      title="Fly to the worst; again for the next"
      onClick={fly}
    >
      <Icon name="target" size={14} />
    </button>
  );
}

function MetricTable({ found }: { found: Report }) {
  return (
    <section class="section">
      <h2>Measures</h2>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Measures">
        <table class="measures">
          <thead>
            <tr>
              <th scope="col">Measure</th>
              <th scope="col" class="num">
                Min
              </th>
              <th scope="col" class="num">
                Median
              </th>
              <th scope="col" class="num">
                Max
              </th>
              <th scope="col">
                <span class="sr">Worst</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {found.quality.metrics.map((metric) => (
              <tr key={metric.name}>
                <th
                  scope="row"
                  title={`1st percentile ${short(metric.p1)}, 99th ${short(metric.p99)}, mean ${short(metric.mean)}, over ${whole(metric.count)} ${metric.elements}`}
                >
                  {sentence(metric.name)} <span class="unit">{unitSign(metric.unit)}</span>
                </th>
                <td class="num">{short(metric.min)}</td>
                <td class="num">{short(metric.median)}</td>
                <td class="num">{short(metric.max)}</td>
                <td>
                  <WorstButton metric={metric} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function Fidelity({ found }: { found: Report }) {
  const { labels, mesh_to_surface: there, surface_to_mesh: back } = found.fidelity;
  const nameOf = (label: number) =>
    volume.value?.labels.find((entry) => entry.label === label)?.name || `Label ${label}`;
  const colour = colourOf.value;
  return (
    <section class="section">
      <h2>Fidelity to the labels</h2>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Fidelity to the labels">
        <table class="measures">
          <thead>
            <tr>
              <th scope="col">Label</th>
              <th scope="col" class="num">
                Volume
              </th>
              <th scope="col" class="num">
                Dice
              </th>
              <th scope="col" class="num">
                Edge mm
              </th>
            </tr>
          </thead>
          <tbody>
            {labels.map((row) => (
              <tr key={row.label}>
                <th scope="row">
                  <svg class="dot" viewBox="0 0 8 8" aria-hidden="true">
                    <circle cx="4" cy="4" r="4" fill={colour(row.label)} />
                  </svg>
                  {nameOf(row.label)}
                </th>
                <td
                  class="num"
                  title={`${short(row.mesh_mm3 / 1000)} ml meshed, ${short(row.voxel_mm3 / 1000)} ml in voxels`}
                >
                  {row.volume_error_percent >= 0 ? '+' : ''}
                  {row.volume_error_percent.toFixed(2)} %
                </td>
                <td class="num">{row.dice.toFixed(3)}</td>
                <td class="num" title="median achieved / prescribed">
                  {short(row.median_edge_mm)} / {short(row.wished_edge_mm)}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="facts">
        Distance to the label surface: mean {short(there.mean_mm)} mm, largest {short(there.max_mm)} mm; back:
        mean {short(back.mean_mm)} mm, largest {short(back.max_mm)} mm.
      </p>
    </section>
  );
}

export function EvidencePanel() {
  const found = report.value;
  return (
    <aside class="panel right" aria-label="Evidence">
      <VerdictCard />
      {!found && (
        <div class="panel-empty">
          <svg viewBox="0 0 120 56" width="120" height="56" aria-hidden="true">
            {[8, 14, 26, 40, 46, 38, 24, 15, 9, 5].map((bar, i) => (
              <rect key={i} x={4 + i * 11.4} y={52 - bar} width="8.4" height={bar} rx="1.5" />
            ))}
          </svg>
          <h2>Evidence</h2>
          <p>
            After a run: the checklist, prescribed against achieved edge length, aspect ratios before and
            after, dihedral angles, and the fidelity to the labels.
          </p>
        </div>
      )}
      {found && (
        <>
          <Summary found={found} />
          <Checklist found={found} />
          <Histograms found={found} />
          <Fidelity found={found} />
          <MetricTable found={found} />
          {found.warnings.length > 0 && (
            <section class="section">
              <h2>Warnings</h2>
              <ul class="warnings">
                {found.warnings.map((warning) => (
                  <li key={warning}>{warning}</li>
                ))}
              </ul>
            </section>
          )}
        </>
      )}
    </aside>
  );
}
