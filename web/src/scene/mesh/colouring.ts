/** From what the store shows to colours: pure choices, no three.js. */
import type { LayerArray, StageArrays, SurfaceArrays, TetMeasure } from '../../engine/contract';
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
import { nameOf, voxelMm } from '../../store/case/input';
import { shownKeys } from '../../store/run/results';
import { sizingFields } from '../../store/run/sizing_fields';
import {
  colourBy,
  colourOf,
  fractionLabel,
  hiddenLabels,
  type DistanceUnit,
  type Legend,
} from '../../store/view';

export type TetPaint =
  | { kind: 'label' }
  | { kind: 'given'; values: Float32Array }
  | { kind: 'scale'; values: Float32Array; legend: Legend }
  /** A value a tet, below 0 where it has none. */
  | { kind: 'parts'; values: Float32Array; legend: Legend }
  /** A value a point, below 0 where it has none; faces are coloured by the largest of their corners. */
  | { kind: 'points'; values: Float32Array; legend: Legend };

type Scale = Omit<Legend, 'lo' | 'hi'>;

const scales: Record<TetMeasure | DistanceUnit | LayerArray | 'target_mm' | 'thickness_mm', Scale> = {
  edge_mm: { title: 'Mean edge length', unit: 'mm', map: 'viridis' },
  target_mm: { title: 'Target edge length', unit: 'mm', map: 'viridis' },
  thickness_mm: { title: 'Wall thickness', unit: 'mm', map: 'cividis' },
  distance_mm: { title: 'Distance to the label surface', unit: 'mm', map: 'viridis' },
  distance_voxels: { title: 'Distance to the label surface', unit: 'voxels', map: 'viridis' },
  layer: { title: 'Layer, from the inner surface', unit: '', map: 'viridis', whole: true },
  layers_across: { title: 'Layers across the wall', unit: '', map: 'viridis', whole: true },
  size_log2: { title: 'Edge length over target', unit: 'log₂', map: 'vik' },
  min_dihedral_deg: { title: 'Smallest dihedral angle', unit: '°', map: 'cividis' },
  max_dihedral_deg: { title: 'Largest dihedral angle', unit: '°', map: 'cividis' },
  radius_ratio: { title: 'Radius ratio', unit: '', map: 'cividis' },
  mean_ratio: { title: 'Mean ratio', unit: '', map: 'cividis' },
  aspect_ratio: { title: 'Aspect ratio', unit: '', map: 'cividis' },
};

/** Target edge lengths, from the edge lengths and their ratio. */
function targets(measures: StageArrays['quality']): Float32Array {
  return measures.edge_mm.map((edge, tet) => edge / 2 ** measures.size_log2[tet]);
}

function scaled(values: Float32Array, scale: Scale): TetPaint {
  let [lo, hi] = robustRange(values);
  // Ratios are read from their middle: as much above the target as below it.
  if (scale.map === 'vik') [lo, hi] = [-Math.max(-lo, hi), Math.max(-lo, hi)];
  return { kind: 'scale', values, legend: { ...scale, lo, hi } };
}

function distancePaint(distances: Float32Array | undefined, by: DistanceUnit): TetPaint {
  if (!distances) return { kind: 'label' };
  const unit = by === 'distance_voxels' ? voxelMm.value : 1;
  const values = distances.map((distance) => (distance < 0 ? -1 : distance / unit));
  const [, hi] = robustRange(values, (point) => values[point] >= 0);
  return { kind: 'points', values, legend: { ...scales[by], lo: 0, hi } };
}

function layerPaint(values: Float32Array | undefined, by: LayerArray): TetPaint {
  if (!values) return { kind: 'label' };
  const most = values.reduce((known, value) => Math.max(known, value), 1);
  const fewest = values.reduce((known, value) => (value < 0 ? known : Math.min(known, value)), most);
  const [lo, hi] = most > fewest ? [fewest, most] : [most - 1, most + 1];
  return { kind: 'parts', values, legend: { ...scales[by], lo, hi } };
}

export function tetPaint(measures: StageArrays['quality'] | undefined): TetPaint {
  const by = colourBy.value;
  if (by === 'label' || by === 'thickness_mm' || !measures) return { kind: 'label' };
  if (by === 'distance_mm' || by === 'distance_voxels') return distancePaint(measures.distance_mm, by);
  if (by === 'layer' || by === 'layers_across') return layerPaint(measures[by], by);
  if (by === 'target_mm') return scaled(targets(measures), scales.target_mm);
  const values = measures[by];
  if (!values) return { kind: 'label' };
  if (by === 'centroid_label' || by === 'majority_label') return { kind: 'given', values };
  const label = fractionLabel(by);
  if (label === null) return scaled(values, scales[by as TetMeasure]);
  const legend: Legend = { title: `Share of ${nameOf(label)}`, unit: '', map: 'viridis', lo: 0, hi: 1 };
  return { kind: 'scale', values, legend };
}

function labelPainter(): Painter {
  const colour = colourOf.value;
  const cache = new Map<number, [number, number, number]>([[0, [150, 150, 150]]]);
  return (_, label, out, at) => {
    let rgb = cache.get(label);
    if (!rgb) cache.set(label, (rgb = rgbOf(colour(label))));
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
  const painted = values && scaled(values, scales[by as 'edge_mm']);
  const legend = painted?.kind === 'scale' ? painted.legend : null;
  const paint = values && legend ? scalePainter(values, legend) : labelPainter();
  const body = { faces: surfaceFaces(mesh, hiddenLabels.value, paint), legend };
  bodies.set(mesh, { from, body });
  return body;
}
