import { effect, untracked } from '@preact/signals';
import { Vector3 } from 'three';
import type { StageArrays, TetArrays } from '../../engine/contract';
import { tetMask } from '../../geometry/tet_faces';
import { brush, colourBy, explode, focusTet, hiddenLabels, legend, type Brush } from '../../store/view';
import { pinnedValues, simulatedValues } from '../../store/run/simulated_fields';
import type { BodyView } from './body_view';
import type { Canvas } from '../frame/canvas';
import { simulatedPaint, tetPaint } from './colouring';
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

export function tetCentre(mesh: TetArrays, tet: number): { centre: Vector3; size: number } {
  const corners = [0, 1, 2, 3].map((k) => new Vector3().fromArray(mesh.points, 3 * mesh.tets[4 * tet + k]));
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
  const near = focus === null ? null : tetCentre(mesh, focus);
  const ball = near ? { centre: near.centre.toArray(), radius: 2.2 * near.size } : undefined;
  const ranges = brushed(brush.value, measures);
  const { mask, count } = tetMask(mesh.centres, { hidden: hiddenLabels.value, ranges, ball });
  return { mask, count, partly: ranges !== undefined || ball !== undefined };
}

/** Shows a tetrahedral mesh with the cut, the colours and the choice of elements of the store. */
export function followTets(
  canvas: Canvas,
  body: BodyView,
  { source, plane, leads, onModel }: Follower,
): () => void {
  const valuesOf = leads ? simulatedValues : pinnedValues;
  const stops = [
    effect(() => {
      const shown = source();
      if (!shown) return;
      const model = body.showTets(shown.mesh);
      if (model) {
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
      const { mask, count, partly } = chosenTets(shown.mesh, shown.measures, focus);
      body.model.setMask(mask, partly, hiddenLabels.value.size > 0);
      body.model.single(focus);
      const range = untracked(() => brush.value);
      if (leads && range && range.shown !== count) brush.value = { ...range, shown: count };
      canvas.invalidate();
    }),
    effect(() => {
      const shown = source();
      if (!shown || !body.model) return;
      const paint = simulatedPaint(valuesOf) ?? tetPaint(shown.measures);
      const scaled = 'legend' in paint;
      if (leads) legend.value = scaled ? paint.legend : null;
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
      void source();
      body.setPlane(plane());
      body.model?.setExplode(explode.value);
      canvas.invalidate();
    }),
  ];
  return () => stops.forEach((stop) => stop());
}
