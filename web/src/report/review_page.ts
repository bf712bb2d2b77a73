/**
 * The evidence of a run, for whoever reviews it: one page that needs nothing else, to be read, printed and kept. Text,
 * tables, histograms as SVG, pictures inside.
 */
import { promisedStages, type ChecklistItem, type Report, type Simulated } from '../engine/contract';
import type { Verdict } from '../link/verdict';
import { seriesOf, shapeMeasures } from './charts';
import { escaped, histogramSvg, number, table, toneStyle, whole } from './markup';

export interface ReportPicture {
  title: string;
  /** data: URL. */
  source: string;
}

export interface ReviewContext {
  title: string;
  /** Of the case, with what it promises. */
  link: string;
  pictures: readonly ReportPicture[];
  nameOf(label: number): string;
  /** Null where no link has promised anything. */
  verdict: Verdict | null;
  /** BibTeX. */
  citation: string;
}

const verdictWords = {
  reproduced: 'reproduced, byte for byte',
  differs: 'differs from what the link promises',
  other_engine: 'made with another engine than the link',
  awaited: 'promised by the link, not run yet',
};

function verdictPart(verdict: Verdict | null): string {
  if (!verdict)
    return '<p class="verdict">No link has promised this run: it is as it was made. Its own link promises it from here on.</p>';
  const { mesh, simulation, rows } = verdict;
  const words = [`The mesh: ${verdictWords[mesh]}.`];
  if (simulation) words.push(`The simulation: ${verdictWords[simulation]}.`);
  const cells = rows.map(({ name, expected, found, same }) => [name, expected, found, same ? 'yes' : 'no']);
  return `<p class="verdict ${mesh}"><b>${escaped(words.join(' '))}</b></p>
${table(['What', 'Promised', 'Found', 'The same'], cells)}`;
}

function checklist(items: readonly ChecklistItem[]): string {
  const rows = items.map((item) => [
    item.passed ? 'passed' : item.hard ? 'failed' : 'caution',
    item.name.replaceAll('_', ' '),
    item.found,
    item.expected,
  ]);
  return table(['State', 'Check', 'Found', 'Expected'], rows, 0);
}

/** What everything was made from and is known by. */
function identityRows(found: Report): string[][] {
  const { source, recipe } = found;
  const rows = [
    ['Volume', recipe.source.phantom ? `generated: ${recipe.source.phantom.kind}` : source.name],
    ['Voxels', `${source.size.join(' × ')} of ${source.spacing_mm.map(number).join(' × ')} mm`],
    ['Edge length', `${recipe.sizing.edge_mm} mm`],
    ['Tetrahedra', whole(found.tets)],
    ['Points', whole(found.points)],
    ['Engine', `voxtet ${found.engine}`],
    ...(found.physics ? [['Physics', found.physics]] : []),
    ['Digest of the volume', source.digest],
    ['Digest of the mesh', found.digest],
  ];
  const simulated = found.stages.filter(({ name }) => (promisedStages as readonly string[]).includes(name));
  return [...rows, ...simulated.map(({ name, digest }) => [`Digest of ${name}`, digest])];
}

function certificate(found: Report): string {
  const hard = found.quality.checklist.filter((item) => item.hard);
  const failed = hard.filter((item) => !item.passed);
  const cautions = found.quality.checklist.filter((item) => !item.hard && !item.passed).length;
  const verdict =
    failed.length === 0
      ? `All ${hard.length} checks that a simulation needs hold.`
      : `${failed.length} of ${hard.length} checks that a simulation needs fail.`;
  return `${verdict}${cautions > 0 ? ` ${cautions} more call for care.` : ''}`;
}

const ventricles = [
  ['lv', 'Left ventricle'],
  ['rv', 'Right ventricle'],
] as const;

function simulationPart({ eikonal, monodomain, mechanics }: Simulated): string {
  const rows: string[][] = [];
  if (eikonal)
    rows.push(
      ['Activation map, last point', `${number(eikonal.last_ms)} ms`],
      ['Activation map, points reached', `${number(100 * eikonal.activated)} %`],
    );
  if (monodomain)
    rows.push(
      ['Wave, until', `${number(monodomain.end_ms)} ms`],
      ['Wave, points activated', `${number(100 * monodomain.activated)} %`],
      ['Total activation time', `${number(monodomain.total_activation_ms)} ms`],
      ['Most activations of a point', String(monodomain.most_activations)],
    );
  const last = mechanics?.beats.at(-1);
  if (last)
    rows.push(
      ['Heartbeat, beats', String(mechanics?.beats.length)],
      ...ventricles.flatMap(([name, title]) => [
        [`${title}, end-diastolic volume`, `${number(last[name].end_diastolic_ml)} ml`],
        [`${title}, end-systolic volume`, `${number(last[name].end_systolic_ml)} ml`],
        [`${title}, ejection fraction`, `${number(100 * last[name].ejection_fraction)} %`],
        [`${title}, highest pressure`, `${number(last[name].most_kpa)} kPa`],
      ]),
    );
  return rows.length > 0 ? `<h2>Simulation</h2>${table(['What', 'Found'], rows)}` : '';
}

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

const style = `:host,body{font:15px/1.5 system-ui,sans-serif;color:#17202b;background:#fff}
article{max-width:960px;margin:0 auto;padding:24px 20px}
h1{font-size:24px;margin:0 0 4px}h2{font-size:17px;margin:32px 0 8px;border-bottom:1px solid #d7dde4;break-after:avoid}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}tr,figure{break-inside:avoid}
th,td{text-align:left;padding:3px 10px 3px 0;border-bottom:1px solid #e7ebf0;vertical-align:top;overflow-wrap:anywhere}.num{text-align:right}
.num,td:first-child{white-space:nowrap}
th{font-weight:500;color:#4b5866}figure{margin:12px 0}figcaption{font-size:13px}img{max-width:100%;border-radius:6px}
.charts,.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:8px 28px}svg text{font-size:11px;fill:#4b5866}
pre{background:#f4f6f8;padding:12px;border-radius:6px;overflow:auto;font-size:12px;white-space:pre-wrap;overflow-wrap:anywhere}
.verdict{padding:8px 12px;border-radius:6px;background:#f4f6f8}.reproduced{background:#e4f3ea}.differs{background:#fbe9e7}.other_engine{background:#fdf3dc}
a{color:#0b6b72;overflow-wrap:anywhere}
@media print{article{max-width:none;padding:0}a[href]::after{content:" " attr(href);font-size:10px;overflow-wrap:anywhere}h2{margin-top:20px}}
@page{margin:16mm}
${toneStyle}`;

export interface ReviewPage {
  /** HTML of the page's content, and its style sheet. */
  body: string;
  style: string;
}

/** The whole page as a file. */
export function htmlFile(title: string, { body, style }: ReviewPage): string {
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>${escaped(title)}: mesh report</title><style>${style}</style></head><body>${body}</body></html>
`;
}

export function reviewPage(found: Report, context: ReviewContext): ReviewPage {
  return { body: bodyOf(found, context), style };
}

function bodyOf(found: Report, context: ReviewContext): string {
  const { pictures, nameOf, verdict, citation } = context;
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
  return `<article><h1>${escaped(context.title)}</h1>
<p>Evidence of a tetrahedral mesh. ${certificate(found)}</p>
${verdictPart(verdict)}
<h2>What it is</h2>
${table(['What', 'Value'], identityRows(found))}
<p><a href="${escaped(context.link)}">Open this case in voxtet</a>: running it says whether the mesh is reproduced.</p>
<div class="pictures">${images.join('\n')}</div>
<h2>Checks</h2>
${checklist(found.quality.checklist)}
${warnings && `<h2>Warnings</h2><ul>${warnings}</ul>`}
<h2>Distributions</h2>
<div class="charts">${figures.join('\n')}</div>
${found.fidelity ? fidelityPart(found.fidelity, nameOf) : ''}
${found.simulation ? simulationPart(found.simulation) : ''}
<h2>Measures</h2>
${table(['Measure', 'Min', '1 %', 'Median', '99 %', 'Max', 'Mean'], measures, 6)}
<h2>Stages</h2>
${table(['Stage', 'Seconds', 'Peak, MB', 'Notes'], stages, 2)}
<h2>Recipe</h2>
<pre>${escaped(JSON.stringify(found.recipe, null, 2))}</pre>
<h2>How to cite</h2>
<pre>${escaped(citation)}</pre></article>
`;
}
