/** From what the store shows to triangles with colours: pure choices, no three.js. */
import type { StageName, SurfaceArrays, TetArrays } from '../engine/contract';
import { colourTable, rgbOf, type ColourMapName } from '../geometry/colours';
import {
  keptTets,
  outerFaces,
  robustRange,
  surfaceFaces,
  triangleEdges,
  type Faces,
  type Painter,
  type TetFilter,
} from '../geometry/faces';
import { shownResult } from '../store/results';
import { brush, colourBy, colourOf, hiddenLabels, type ColourBy, type Legend } from '../store/view';

export interface Body {
  faces: Faces;
  /** Outline of everything that the filter leaves out, for context. */
  ghost?: Faces;
  smooth: boolean;
  legend: Legend | null;
  /** Elements that the faces belong to. */
  count: number;
}

const measureTitles: Record<
  Exclude<ColourBy, 'label'>,
  { title: string; unit: string; map: ColourMapName }
> = {
  edge_mm: { title: 'Mean edge length', unit: 'mm', map: 'viridis' },
  min_dihedral_deg: { title: 'Smallest dihedral angle', unit: '°', map: 'cividis' },
  radius_ratio: { title: 'Radius ratio', unit: '', map: 'cividis' },
  size_log2: { title: 'Achieved over prescribed edge', unit: 'log₂', map: 'viridis' },
};

function labelPainter(): Painter {
  const colour = colourOf.value;
  const cache = new Map<number, [number, number, number]>();
  return (_, label, out, at) => {
    let rgb = cache.get(label);
    if (!rgb) cache.set(label, (rgb = rgbOf(colour(label))));
    out[at] = rgb[0];
    out[at + 1] = rgb[1];
    out[at + 2] = rgb[2];
  };
}

function scalePainter(
  values: Float32Array,
  by: Exclude<ColourBy, 'label'>,
): { paint: Painter; legend: Legend } {
  const { title, unit, map } = measureTitles[by];
  const table = colourTable(map);
  const [lo, hi] = robustRange(values);
  return {
    legend: { title, unit, lo, hi, map },
    paint: (element, _, out, at) => {
      const x = Math.max(0, Math.min(255, Math.round((255 * (values[element] - lo)) / (hi - lo))));
      out[at] = table[3 * x];
      out[at + 1] = table[3 * x + 1];
      out[at + 2] = table[3 * x + 2];
    },
  };
}

export function surfaceBody(stage: 'surface' | 'smooth' | 'remesh', mesh: SurfaceArrays): Body {
  const scaled =
    colourBy.value === 'edge_mm' ? scalePainter(triangleEdges(mesh.points, mesh.triangles), 'edge_mm') : null;
  const smooth = stage === 'smooth';
  const faces = surfaceFaces(mesh, { hidden: hiddenLabels.value, smooth }, scaled?.paint ?? labelPainter());
  return { faces, smooth, legend: scaled?.legend ?? null, count: faces.owners.length };
}

export function tetBody(mesh: TetArrays, plane: TetFilter['plane'], ball: TetFilter['ball']): Body {
  const measures = shownResult('quality');
  const by = colourBy.value;
  const scaled = by !== 'label' && measures ? scalePainter(measures[by], by) : null;
  const range = brush.value;
  const filter: TetFilter = { hidden: hiddenLabels.value, plane, ball };
  if (range && measures) {
    const values =
      range.metric === 'dihedral_deg'
        ? [measures.min_dihedral_deg, measures.max_dihedral_deg]
        : [measures[range.metric]];
    filter.ranges = { values, lo: range.lo, hi: range.hi };
  }
  const { kept, count } = keptTets(mesh.points, mesh.tets, mesh.labels, filter);
  const body: Body = {
    faces: outerFaces(mesh, kept, scaled?.paint ?? labelPainter()),
    smooth: false,
    legend: scaled?.legend ?? null,
    count,
  };
  if (filter.ranges || ball) {
    const all = keptTets(mesh.points, mesh.tets, mesh.labels, { hidden: hiddenLabels.value });
    body.ghost = outerFaces(mesh, all.kept, (_, __, out, at) => out.fill(150, at, at + 3));
  }
  return body;
}

/** The points of whatever stage has them, for the extent of the view. */
export function pointsOf(stage: StageName): Float32Array | undefined {
  const own = stage === 'quality' ? 'tetra' : stage;
  if (own === 'surface' || own === 'smooth' || own === 'remesh' || own === 'tetra')
    return shownResult(own)?.points;
  return shownResult('surface')?.points;
}
