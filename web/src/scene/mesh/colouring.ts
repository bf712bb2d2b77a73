/** From what the store shows to colours: pure choices, no three.js. */
import { untracked } from '@preact/signals';
import type { FieldInfo, StageArrays, SurfaceArrays, TetArrays } from '../../engine/contract';
import { colourTable, rgbOf } from '../../geometry/colours';
import {
  robustRange,
  surfaceFaces,
  triangleCentres,
  triangleEdges,
  type Faces,
  type Painter,
} from '../../geometry/faces';
import { valuesAt } from '../../geometry/grid_values';
import { endsAround, roundStep, withCounts } from '../../geometry/scale';
import { playedFields } from '../../store/run/frames';
import { report } from '../../store/run/report';
import { shownKeys } from '../../store/run/results';
import { simulatedFields, simulatedValues } from '../../store/run/simulated_fields';
import { sizingFields, thicknessRange } from '../../store/run/sizing_fields';
import { colourBy, fractionLabel, hiddenLabels, type Legend } from '../../store/view';
import { colourOf, nameOf } from '../../store/case/legend/legend';

export type TetPaint =
  | { kind: 'label' }
  | { kind: 'given'; values: Float32Array }
  | { kind: 'scale'; values: Float32Array; legend: Legend }
  /** A value a tet, below 0 where it has none. */
  | { kind: 'parts'; values: Float32Array; legend: Legend }
  /** A value a point, below 0 where it has none; faces are coloured by the largest of their corners. */
  | { kind: 'points'; values: Float32Array; legend: Legend }
  /** A value a point, with colours that go on between points. */
  | { kind: 'nodal'; values: Float32Array; legend: Legend };

type Scale = Omit<Legend, 'lo' | 'hi'>;

/** Of a label surface. */
const surfaceScales: Record<string, Scale> = {
  edge_mm: { title: 'Mean edge length', unit: 'mm', map: 'viridis' },
  target_mm: { title: 'Target edge length', unit: 'mm', map: 'viridis' },
  thickness_mm: { title: 'Wall thickness', unit: 'mm', map: 'cividis' },
};

const unitSigns: Record<string, string> = { '1': '', deg: '°', log2: 'log₂' };

/** How a field is read, as the engine says it. */
function scaleOf({ title, unit, scale }: FieldInfo): Scale {
  if (scale === 'cyclic') return { title, unit: '', map: 'cycle' };
  const map = scale === 'diverging' ? 'vik' : unit === 'deg' || unit === '1' ? 'cividis' : 'viridis';
  const sign = unitSigns[unit] ?? unit;
  return scale === 'whole' ? { title, unit: sign, map: 'layers', whole: true } : { title, unit: sign, map };
}

/** The map on which the bad end of a measure is loud, where the engine ranks elements by it. */
function alarmOf(name: string, values: Float32Array): 'alarm' | 'alarm_low' | null {
  const metric = report.value?.quality.metrics.find((one) => one.name === name && one.elements === 'tets');
  const worst = metric?.worst[0];
  if (!metric || worst === undefined) return null;
  return values[worst] < metric.median ? 'alarm_low' : 'alarm';
}

function scaled(values: Float32Array, scale: Scale): TetPaint & { kind: 'scale' } {
  let ends = endsAround(robustRange(values));
  // Ratios are read from their middle: as much above the target as below it.
  if (scale.map === 'vik') ends = { lo: -Math.max(-ends.lo, ends.hi), hi: Math.max(-ends.lo, ends.hi) };
  return { kind: 'scale', values, legend: withCounts({ ...scale, ...ends }, values) };
}

const notBelow0 = (value: number) => value >= 0;

function pointPaint(values: Float32Array, scale: Scale): TetPaint {
  const [, most] = robustRange(values, (point) => values[point] >= 0);
  const legend = { ...scale, lo: 0, hi: endsAround([0, most]).hi };
  return { kind: 'points', values, legend: withCounts(legend, values, notBelow0) };
}

function wholePaint(values: Float32Array, scale: Scale): TetPaint {
  const most = values.reduce((known, value) => Math.max(known, value), 1);
  const fewest = values.reduce((known, value) => (value < 0 ? known : Math.min(known, value)), most);
  return { kind: 'parts', values, legend: withCounts({ ...scale, lo: fewest, hi: most }, values, notBelow0) };
}

/** The labels of which tets have the colours, of those that are shown. */
export function paintedLabels(paint: TetPaint, mesh: TetArrays): number[] {
  if (paint.kind !== 'label' && paint.kind !== 'given') return [];
  const labels = paint.kind === 'given' ? paint.values : mesh.ways.filter((_, i) => i % 4 === 0);
  const hidden = paint.kind === 'label' ? hiddenLabels.value : new Set<number>();
  return [...new Set(labels)].filter((label) => label > 0 && !hidden.has(label)).sort((a, b) => a - b);
}

export function tetPaint(measures: StageArrays['quality'] | undefined): TetPaint {
  const by = colourBy.value;
  const field = measures?.fields.find(({ name }) => name === by);
  if (!measures || !field) return { kind: 'label' };
  const values = measures.values[by];
  if (field.scale === 'label') return { kind: 'given', values };
  if (field.on === 'points') return pointPaint(values, scaleOf(field));
  if (field.scale === 'whole') return wholePaint(values, scaleOf(field));
  const label = fractionLabel(by);
  if (label === null) {
    const scale = scaleOf(field);
    const alarm = field.scale === 'sequential' ? alarmOf(by, values) : null;
    return scaled(values, alarm ? { ...scale, map: alarm } : scale);
  }
  const legend: Legend = { title: `Share of ${nameOf(label)}`, unit: '', map: 'viridis', lo: 0, hi: 1 };
  return { kind: 'scale', values, legend: withCounts(legend, values) };
}

/** Ends of a scale in round numbers, moved by no more than a fortieth of its length. */
export function roundEnds([least, most]: readonly [number, number]): { lo: number; hi: number } {
  if (!(most > least)) return { lo: least, hi: least + 1 };
  const unit = (most - least) / 20;
  const power = 10 ** Math.floor(Math.log10(unit));
  const step = unit >= 5 * power ? 5 * power : power;
  const rounded = (end: number) => step * Math.round(end / step) || 0; // never -0
  return { lo: rounded(least), hi: rounded(most) };
}

/** Whole bands over a range, about twelve, at least three. */
export function bandEnds([least, most]: readonly [number, number]): {
  lo: number;
  hi: number;
  bands: number;
} {
  const bands = roundStep(((most > least ? most : least + 1) - least) / 12);
  const first = Math.floor(least / bands);
  const count = Math.max(3, Math.ceil(most / bands) - first);
  return { lo: first * bands, hi: (first + count) * bands, bands };
}

/** What the phase is called at -135, -45, 45 and 135 degrees. */
const phaseWords = ['rest', 'front', 'excited', 'recovery'];

/** A field of a simulation, on the scale of all its frames; nothing where it is not what is coloured by. */
export function simulatedPaint(valuesOf = simulatedValues): TetPaint | null {
  const named = ({ info }: { info: FieldInfo }) => info.name === colourBy.value;
  const played = playedFields.value.find(named);
  const field = simulatedFields.value.find(named);
  const values = untracked(() => valuesOf(colourBy.value));
  if (!field || !values) return null;
  // Times that are found once are read as isochrones.
  const banded = !played && field.info.unit === 'ms' && field.info.scale !== 'diverging';
  const wide = field.most ?? field.range;
  const most = Math.max(Math.abs(wide[0]), Math.abs(wide[1]));
  const range: [number, number] = field.info.scale === 'diverging' ? [-most, most] : wide;
  const cyclic = field.info.scale === 'cyclic';
  const ends = banded ? bandEnds(range) : cyclic ? { lo: range[0], hi: range[1] } : roundEnds(range);
  const legend: Legend = {
    ...scaleOf(field.info),
    ...ends,
    values: field.range,
    ...(cyclic && { words: phaseWords }),
  };
  return { kind: field.info.on === 'points' ? 'nodal' : 'scale', values, legend };
}

function labelPainter(seen: Set<number>): Painter {
  const colour = colourOf.value;
  const cache = new Map<number, [number, number, number]>([[0, [150, 150, 150]]]);
  return (_, label, out, at) => {
    let rgb = cache.get(label);
    if (!rgb) cache.set(label, (rgb = rgbOf(colour(label))));
    seen.add(label);
    out[at] = rgb[0];
    out[at + 1] = rgb[1];
    out[at + 2] = rgb[2];
  };
}

function scalePainter(values: Float32Array, { lo, hi, map }: Legend): Painter {
  const table = colourTable(map);
  return (element, _, out, at) => {
    if (Number.isNaN(values[element])) return void out.fill(150, at, at + 3);
    const x = Math.max(0, Math.min(255, Math.round((255 * (values[element] - lo)) / (hi - lo))));
    out[at] = table[3 * x];
    out[at + 1] = table[3 * x + 1];
    out[at + 2] = table[3 * x + 2];
  };
}

export interface SurfaceBody {
  faces: Faces;
  legend: Legend | null;
  /** Where there is no legend: the labels that it has the colours of. */
  labels: readonly number[];
}

/** What a surface's triangles are coloured by, where that is a number. */
function triangleValues({ points, triangles }: SurfaceArrays): Float32Array | null {
  const by = colourBy.value;
  if (by === 'edge_mm') return triangleEdges(points, triangles);
  if (by !== 'target_mm' && by !== 'thickness_mm') return null;
  const fields = sizingFields();
  const field = by === 'target_mm' ? fields?.size : fields?.thickness;
  return field ? valuesAt(field.values, field.grid, triangleCentres(points, triangles)) : null;
}

/** The last body of each surface, with what it was made from: the view often asks for the same again. */
const bodies = new WeakMap<SurfaceArrays, { from: unknown[]; body: SurfaceBody }>();

export function surfaceBody(mesh: SurfaceArrays): SurfaceBody {
  const by = colourBy.value;
  const fields = by === 'target_mm' || by === 'thickness_mm' ? shownKeys.value.sizing : null;
  const from = [by, fields, hiddenLabels.value, colourOf.value];
  const known = bodies.get(mesh);
  if (known && from.every((part, i) => part === known.from[i])) return known.body;
  const values = triangleValues(mesh);
  const legend = values && scaled(values, surfaceScales[by]).legend;
  // What was measured, not only where triangles are.
  if (legend && by === 'thickness_mm') legend.values = thicknessRange() ?? legend.values;
  const seen = new Set<number>();
  const paint = values && legend ? scalePainter(values, legend) : labelPainter(seen);
  const faces = surfaceFaces(mesh, hiddenLabels.value, paint);
  const body = { faces, legend, labels: [...seen].sort((a, b) => a - b) };
  bodies.set(mesh, { from, body });
  return body;
}
