import { effect, untracked } from '@preact/signals';
import { Vector3 } from 'three';
import type { StageArrays, StageName, TetArrays } from '../../engine/contract';
import { tetMask } from '../../geometry/tet_faces';
import {
  brush,
  colourBy,
  explode,
  focusTet,
  hiddenLabels,
  labelsShown,
  legend,
  type Brush,
} from '../../store/view';
import { movesShown, pinnedMoves, restOutlined } from '../../store/run/beat/motion';
import { pinnedValues, simulatedValues } from '../../store/run/simulated_fields';
import type { BodyView } from './body_view';
import type { Canvas } from '../frame/canvas';
import { paintedLabels, simulatedPaint, tetPaint } from './colouring';
import type { Plane, TetModel } from './tet_model';
import { colourOf } from '../../store/case/legend/legend';

export interface TetSource {
  mesh: TetArrays;
  measures: StageArrays['quality'] | undefined;
}

interface Follower {
  /** What is to be shown now, or nothing. */
  source(): TetSource | null;
  plane(): Plane | null;
  /** Its scale and its chosen elements are those that the panels tell of. */
  leads: boolean;
  /** There is a new mesh on the graphics card. */
  onModel?(model: TetModel, mesh: TetArrays): void;
}

export const isOnTets = (stage: StageName): boolean => stage === 'optimise' || stage === 'quality';

/** Corners of a tet, moved with its label where the labels are pulled apart. */
export function tetCorners(mesh: TetArrays, tet: number, apart = 0): Vector3[] {
  const { points, tets, labels, ways } = mesh;
  const at = ways.findIndex((label, i) => i % 4 === 0 && label === labels[tet]);
  const shift = new Vector3().fromArray(ways, at + 1).multiplyScalar(apart);
  return [0, 1, 2, 3].map((k) => new Vector3().fromArray(points, 3 * tets[4 * tet + k]).add(shift));
}

export function tetCentre(mesh: TetArrays, tet: number, apart = 0): { centre: Vector3; size: number } {
  const corners = tetCorners(mesh, tet, apart);
  const centre = corners.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(4);
  return { centre, size: Math.max(...corners.map((p) => p.distanceTo(corners[0]))) };
}

/** The values that a dragged range of a histogram is about. */
function brushed(range: Brush | null, measures: TetSource['measures']) {
  if (!range || !measures) return undefined;
  const names = range.metric === 'dihedral_deg' ? ['min_dihedral_deg', 'max_dihedral_deg'] : [range.metric];
  const values = names.map((name) => measures.values[name]);
  return { values, lo: range.lo, hi: range.hi };
}

function chosenTets(mesh: TetArrays, measures: TetSource['measures'], focus: number | null) {
  const single = focus === null ? undefined : { tet: focus, radius: 2.2 * tetCentre(mesh, focus).size };
  const ranges = brushed(brush.value, measures);
  const { mask, count } = tetMask(mesh.centres, { hidden: hiddenLabels.value, ranges, single });
  return { mask, count, show: single ? ('one' as const) : ranges ? ('some' as const) : ('all' as const) };
}

/** Shows a tetrahedral mesh with the cut, the colours and the choice of elements of the store. */
export function followTets(
  canvas: Canvas,
  body: BodyView,
  { source, plane, leads, onModel }: Follower,
): () => void {
  const valuesOf = leads ? simulatedValues : pinnedValues;
  let moved = false;
  const stops = [
    effect(() => {
      const shown = source();
      if (!shown) return;
      const model = body.showTets(shown.mesh);
      if (model) {
        moved = false;
        untracked(() => onModel?.(model, shown.mesh));
        void model.upload(canvas.renderer).then(() => canvas.invalidate());
      }
      canvas.invalidate();
    }),
    effect(() => {
      const shown = source();
      if (!shown || !body.model) return;
      const wanted = leads ? focusTet.value : null;
      const focus = wanted !== null && 4 * wanted < shown.mesh.tets.length ? wanted : null;
      const { mask, count, show } = chosenTets(shown.mesh, shown.measures, focus);
      body.model.setMask(mask, show, hiddenLabels.value.size > 0);
      const range = untracked(() => brush.value);
      if (leads && focus === null && range && range.shown !== count) brush.value = { ...range, shown: count };
      canvas.invalidate();
    }),
    effect(() => {
      const shown = source();
      if (!shown || !body.model) return;
      const paint = simulatedPaint(valuesOf) ?? tetPaint(shown.measures);
      const scaled = 'legend' in paint;
      if (leads) {
        legend.value = scaled ? paint.legend : null;
        labelsShown.value = paintedLabels(paint, shown.mesh);
      }
      // Two runs are compared on one scale: that of the run that leads.
      else if (scaled && legend.value) paint.legend = legend.value;
      body.model.setPaint(paint, colourOf.value);
      canvas.invalidate();
    }),
    // From frame to frame only values change.
    effect(() => {
      const values = valuesOf(colourBy.value);
      if (!values || !body.model || !source()) return;
      body.model.setValues(values);
      canvas.invalidate();
    }),
    effect(() => {
      if (!source() || !body.model) return;
      const moves = leads ? movesShown.value : pinnedMoves();
      if (!moves && !moved) return;
      moved = moves !== null;
      body.model.setMoves(moves, restOutlined.value && moved);
      canvas.invalidate();
    }),
    effect(() => {
      void source();
      body.setPlane(plane());
      body.model?.setExplode(explode.value);
      canvas.invalidate();
    }),
  ];
  return () => stops.forEach((stop) => stop());
}
