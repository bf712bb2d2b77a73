/** From what the store shows to triangles with colours: pure choices, no three.js. */
import type { LookedUpArray, StageArrays, StageName, SurfaceArrays, TetArrays } from '../engine/contract';
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
import { nameOf } from '../store/input';
import { shownResult } from '../store/results';
import {
  brush,
  colourBy,
  colourOf,
  fractionLabel,
  hiddenLabels,
  type ColourBy,
  type Legend,
} from '../store/view';

export interface Body {
  faces: Faces;
  /** Outline of everything that the filter leaves out, for context. */
  ghost?: Faces;
  smooth: boolean;
  legend: Legend | null;
  /** Elements that the faces belong to. */
  count: number;
}

interface Scale {
  title: string;
  unit: string;
  map: ColourMapName;
  /** Its ends; else they come from the values. */
  range?: [number, number];
}

type Measure = Exclude<ColourBy, 'label' | LookedUpArray>;

const measureScales: Record<Measure, Scale> = {
  edge_mm: { title: 'Mean edge length', unit: 'mm', map: 'viridis' },
  min_dihedral_deg: { title: 'Smallest dihedral angle', unit: '°', map: 'cividis' },
  radius_ratio: { title: 'Radius ratio', unit: '', map: 'cividis' },
  size_log2: { title: 'Achieved over prescribed edge', unit: 'log₂', map: 'viridis' },
};

/** Colours of the elements' own labels, or of those given for each. */
function labelPainter(given?: Float32Array): Painter {
  const colour = colourOf.value;
  const cache = new Map<number, [number, number, number]>([[0, [150, 150, 150]]]);
  return (element, own, out, at) => {
    const label = given ? given[element] : own;
    let rgb = cache.get(label);
    if (!rgb) cache.set(label, (rgb = rgbOf(colour(label))));
    out[at] = rgb[0];
    out[at + 1] = rgb[1];
    out[at + 2] = rgb[2];
  };
}

interface Paint {
  paint: Painter;
  legend: Legend | null;
}

function scalePainter(values: Float32Array, { title, unit, map, range }: Scale): Paint {
  const table = colourTable(map);
  const [lo, hi] = range ?? robustRange(values);
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

function tetPainter(by: ColourBy, measures: StageArrays['quality'] | undefined): Paint {
  const values = by === 'label' ? undefined : measures?.[by];
  if (by === 'label' || !values) return { paint: labelPainter(), legend: null };
  if (by === 'centroid_label' || by === 'majority_label')
    return { paint: labelPainter(values), legend: null };
  const label = fractionLabel(by);
  if (label === null) return scalePainter(values, measureScales[by as Measure]);
  const title = `Share of ${nameOf(label)}`;
  return scalePainter(values, { title, unit: '', map: 'viridis', range: [0, 1] });
}

export function surfaceBody(stage: 'surface' | 'smooth' | 'remesh', mesh: SurfaceArrays): Body {
  const { paint, legend } =
    colourBy.value === 'edge_mm'
      ? scalePainter(triangleEdges(mesh.points, mesh.triangles), measureScales.edge_mm)
      : { paint: labelPainter(), legend: null };
  const smooth = stage === 'smooth';
  const faces = surfaceFaces(mesh, { hidden: hiddenLabels.value, smooth }, paint);
  return { faces, smooth, legend, count: faces.owners.length };
}

export function tetBody(mesh: TetArrays, plane: TetFilter['plane'], ball: TetFilter['ball']): Body {
  const measures = shownResult('quality');
  const { paint, legend } = tetPainter(colourBy.value, measures);
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
    faces: outerFaces(mesh, kept, paint),
    smooth: false,
    legend,
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
  const own = stage === 'quality' ? 'optimise' : stage;
  if (own === 'surface' || own === 'smooth' || own === 'remesh' || own === 'optimise')
    return shownResult(own)?.points;
  return shownResult('surface')?.points;
}
