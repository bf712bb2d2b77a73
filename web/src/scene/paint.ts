/** From what the store shows to colours: pure choices, no three.js. */
import type { StageArrays, SurfaceArrays, TetMeasure } from '../engine/contract';
import { colourTable, rgbOf } from '../geometry/colours';
import { robustRange, surfaceFaces, triangleEdges, type Faces, type Painter } from '../geometry/faces';
import { nameOf } from '../store/input';
import { colourBy, colourOf, fractionLabel, hiddenLabels, type Legend } from '../store/view';

export type TetPaint =
  | { kind: 'label' }
  | { kind: 'given'; values: Float32Array }
  | { kind: 'scale'; values: Float32Array; legend: Legend };

type Scale = Omit<Legend, 'lo' | 'hi'>;

const scales: Record<TetMeasure | 'target_mm', Scale> = {
  edge_mm: { title: 'Mean edge length', unit: 'mm', map: 'viridis' },
  target_mm: { title: 'Prescribed edge length', unit: 'mm', map: 'viridis' },
  size_log2: { title: 'Achieved over prescribed edge', unit: 'log₂', map: 'vik' },
  min_dihedral_deg: { title: 'Smallest dihedral angle', unit: '°', map: 'cividis' },
  max_dihedral_deg: { title: 'Largest dihedral angle', unit: '°', map: 'cividis' },
  radius_ratio: { title: 'Radius ratio', unit: '', map: 'cividis' },
  mean_ratio: { title: 'Mean ratio', unit: '', map: 'cividis' },
  aspect_ratio: { title: 'Aspect ratio', unit: '', map: 'cividis' },
};

/** Edge lengths that were asked for, from those achieved and their ratio. */
function targets(measures: StageArrays['quality']): Float32Array {
  return measures.edge_mm.map((edge, tet) => edge / 2 ** measures.size_log2[tet]);
}

function scaled(values: Float32Array, scale: Scale): TetPaint {
  let [lo, hi] = robustRange(values);
  // Ratios are read from their middle: as much above the wish as below it.
  if (scale.map === 'vik') [lo, hi] = [-Math.max(-lo, hi), Math.max(-lo, hi)];
  return { kind: 'scale', values, legend: { ...scale, lo, hi } };
}

export function tetPaint(measures: StageArrays['quality'] | undefined): TetPaint {
  const by = colourBy.value;
  if (by === 'label' || !measures) return { kind: 'label' };
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

export function surfaceBody(mesh: SurfaceArrays): SurfaceBody {
  const edges =
    colourBy.value === 'edge_mm' ? scaled(triangleEdges(mesh.points, mesh.triangles), scales.edge_mm) : null;
  const legend = edges?.kind === 'scale' ? edges.legend : null;
  const paint = edges?.kind === 'scale' ? scalePainter(edges.values, edges.legend) : labelPainter();
  return { faces: surfaceFaces(mesh, hiddenLabels.value, paint), legend };
}
