/** The report as one HTML page that needs nothing else: text, tables, histograms as SVG, pictures inside. */
import type { ChecklistItem, Report } from '../engine/contract';
import { coveringRange, rebin } from '../geometry/histogram';
import { seriesOf, shapeMeasures, type Series } from './charts';

export interface ReportPicture {
  title: string;
  /** data: URL. */
  source: string;
}

const escapes: Record<string, string> = {
  '&': '&amp;',
  '<': '&lt;',
  '>': '&gt;',
  '"': '&quot;',
  "'": '&#39;',
};

export function escaped(text: string): string {
  return text.replace(/[&<>"']/g, (sign) => escapes[sign]);
}

const number = (value: number): string =>
  Number.isFinite(value) ? String(Number(value.toPrecision(4))) : '–';
const whole = (value: number): string => Math.round(value).toLocaleString('en');

/** `numbers`: how many columns after the first hold numbers. */
function table(heads: string[], rows: string[][], numbers: number): string {
  const cell = (tag: string, text: string, i: number) =>
    `<${tag}${i > 0 && i <= numbers ? ' class="num"' : ''}>${escaped(text)}</${tag}>`;
  const head = heads.map((text, i) => cell('th', text, i)).join('');
  const body = rows.map((row) => `<tr>${row.map((text, i) => cell('td', text, i)).join('')}</tr>`).join('\n');
  return `<table><thead><tr>${head}</tr></thead><tbody>\n${body}\n</tbody></table>`;
}

const tones: Record<Series['tone'], string> = { now: '#0b6b72', before: '#b0741a', pinned: '#6b4fa0' };
const [chartWidth, chartHeight, chartBins] = [420, 120, 56];

/** Shares of each series in equal bins, as stepped outlines. */
export function histogramSvg(title: string, unit: string, series: readonly Series[]): string {
  const [lo, hi] = coveringRange(series.map(({ histogram }) => histogram));
  const shares = series.map(({ histogram }) => [...rebin(histogram, lo, hi, chartBins)]);
  const top = Math.max(1, ...shares.flat());
  const paths = shares.map((values, i) => {
    const steps = values.map((share, bin) => {
      const y = number(chartHeight - (share / top) * (chartHeight - 8));
      return `L${number((bin * chartWidth) / chartBins)} ${y}H${number(((bin + 1) * chartWidth) / chartBins)}`;
    });
    const colour = tones[series[i].tone];
    return `<path d="M0 ${chartHeight}${steps.join('')}V${chartHeight}Z" fill="${colour}" fill-opacity=".18" stroke="${colour}"/>`;
  });
  const ticks = [0, 0.25, 0.5, 0.75, 1].map(
    (t) =>
      `<text x="${t * chartWidth}" y="${chartHeight + 14}" text-anchor="${t === 0 ? 'start' : t === 1 ? 'end' : 'middle'}">${number(Number((lo + t * (hi - lo)).toPrecision(3)))}</text>`,
  );
  const key = series
    .map(({ name, tone }) => `<span style="color:${tones[tone]}">■ ${escaped(name)}</span>`)
    .join(' ');
  return `<figure><figcaption><b>${escaped(title)}</b> ${escaped(unit)} ${key}</figcaption>
<svg viewBox="0 -4 ${chartWidth} ${chartHeight + 22}" role="img" aria-label="${escaped(title)}">${paths.join('')}<path d="M0 ${chartHeight}H${chartWidth}" stroke="#8b97a5"/>${ticks.join('')}</svg></figure>`;
}

function checklist(items: readonly ChecklistItem[]): string {
  const rows = items.map((item) => [
    item.passed ? 'passed' : item.hard ? 'failed' : 'caution',
    item.name.replaceAll('_', ' '),
    item.found,
    item.expected,
  ]);
  return table(['', 'Check', 'Found', 'Expected'], rows, 0);
}

function caseRows(found: Report): string[][] {
  const { source, recipe } = found;
  const rows = [
    ['Volume', source.name],
    ['Voxels', `${source.size.join(' × ')} of ${source.spacing_mm.map(number).join(' × ')} mm`],
    ['Digest of the volume', source.digest],
    ['Edge length', `${recipe.sizing.edge_mm} mm`],
    ['Engine', `voxtet ${found.engine}`],
    ['Tetrahedra', whole(found.tets)],
    ['Points', whole(found.points)],
    ['Digest of the mesh', found.digest],
  ];
  return rows;
}

const style = `body{font:15px/1.5 system-ui,sans-serif;color:#17202b;max-width:960px;margin:32px auto;padding:0 20px}
h1{font-size:24px}h2{font-size:17px;margin:32px 0 8px;border-bottom:1px solid #d7dde4}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{text-align:left;padding:3px 10px 3px 0;border-bottom:1px solid #e7ebf0;vertical-align:top;overflow-wrap:anywhere}.num{text-align:right}
.num,td:first-child{white-space:nowrap}
th{font-weight:500;color:#53606f}figure{margin:12px 0}figcaption{font-size:13px}img{max-width:100%;border-radius:6px}
.charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(380px,1fr));gap:8px 28px}svg text{font-size:11px;fill:#53606f}
pre{background:#f4f6f8;padding:12px;border-radius:6px;overflow:auto;font-size:12px}`;

/** What a mesh is compared with, in tables. */
function fidelityPart(fidelity: NonNullable<Report['fidelity']>, nameOf: (label: number) => string): string {
  const labels = fidelity.labels.map((row) => [
    nameOf(row.label),
    whole(row.tets),
    number(row.voxel_mm3 / 1000),
    number(row.mesh_mm3 / 1000),
    number(row.volume_error_percent),
    row.dice.toFixed(4),
    `${number(row.median_edge_mm)} / ${number(row.target_edge_mm)}`,
  ]);
  const distances = (['mesh_to_surface', 'surface_to_mesh'] as const).map((way) => {
    const one = fidelity[way];
    const largest = [one.max_mm, one.max_mm + one.uncertainty_mm];
    const values = [one.mean_mm, one.rms_mm, one.p95_mm, ...largest, one.spacing_mm];
    return [way.replaceAll('_', ' '), ...values.map(number)];
  });
  return `<h2>Fidelity to the labels</h2>
${table(['Label', 'Tetrahedra', 'Voxels, ml', 'Mesh, ml', 'Error, %', 'Dice', 'Edge length / target, mm'], labels, 6)}
<p></p>
${table(['Distance, mm', 'Mean', 'RMS', '95 %', 'Largest found', 'None above', 'Sample spacing'], distances, 6)}`;
}

export function reportPage(
  found: Report,
  context: { title: string; link: string; pictures: readonly ReportPicture[]; nameOf(label: number): string },
): string {
  const { pictures, nameOf } = context;
  const charts = seriesOf(found);
  const figures = (
    [
      ['Edge length', 'mm', charts.edges],
      ['Edge length over target', 'log₂', charts.ratios],
      ['Dihedral angles', 'degrees', charts.angles],
      ['Aspect ratio of surface triangles', '', charts.aspects],
      ...shapeMeasures(found).map(({ name, title }) => [title || name, '', charts[name]] as const),
    ] as const
  )
    .filter(([, , series]) => series.length > 0)
    .map(([title, unit, series]) => histogramSvg(title, unit, series));
  const images = pictures.map(
    (picture) =>
      `<figure><img src="${escaped(picture.source)}" alt="${escaped(picture.title)}"><figcaption>${escaped(picture.title)}</figcaption></figure>`,
  );
  const measures = found.quality.metrics.map((metric) => [
    `${metric.name.replaceAll('_', ' ')} (${metric.elements})`,
    ...[metric.min, metric.p1, metric.median, metric.p99, metric.max, metric.mean].map(number),
  ]);
  const stages = found.stages.map((stage) => [
    stage.name,
    number(stage.seconds),
    number(stage.peak_mb),
    stage.notes.join('; '),
  ]);
  const warnings = found.warnings.map((warning) => `<li>${escaped(warning)}</li>`).join('');
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>${escaped(context.title)}: mesh report</title><style>${style}</style></head><body>
<h1>${escaped(context.title)}</h1>
${table(['', ''], caseRows(found), 0)}
<p><a href="${escaped(context.link)}">Open this case in voxtet</a>: running it says whether the mesh is reproduced.</p>
${images.join('\n')}
<h2>Checklist</h2>
${checklist(found.quality.checklist)}
${warnings && `<h2>Warnings</h2><ul>${warnings}</ul>`}
<h2>Distributions</h2>
<div class="charts">${figures.join('\n')}</div>
${found.fidelity ? fidelityPart(found.fidelity, nameOf) : ''}
<h2>Measures</h2>
${table(['Measure', 'Min', '1 %', 'Median', '99 %', 'Max', 'Mean'], measures, 6)}
<h2>Stages</h2>
${table(['Stage', 'Seconds', 'Peak, MB', 'Notes'], stages, 2)}
<h2>Recipe</h2>
<pre>${escaped(JSON.stringify(found.recipe, null, 2))}</pre>
</body></html>
`;
}
