/** The image: three linked slices beside the 3-D view, the same slices as planes in it, and the crosshair of both. */
import { effect, signal, untracked } from '@preact/signals';
import {
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  type IUniform,
  type RawShaderMaterial,
} from 'three';
import type { TetArrays, Vec3 } from '../../engine/contract';
import { robustRange } from '../../geometry/faces';
import type { Grid } from '../../geometry/grid_values';
import { indexMap, sliceFrames, toMm } from '../../geometry/orientation';
import { volume } from '../../store/case/input';
import { paintedVoxels } from '../../store/case/painting';
import { meshedLabels } from '../../store/case/labels';
import { pointsOf, shownResult } from '../../store/run/results';
import { sizingFields } from '../../store/run/sizing_fields';
import {
  dark,
  hiddenLabels,
  layout,
  showEdges,
  sliceLegend,
  sliceOverlay,
  slicePlaces,
  stageShown,
  type Legend,
} from '../../store/view';
import type { Canvas } from '../frame/canvas';
import { setPositions } from '../frame/positions';
import { SliceImage } from './slice_material';
import { SlicePane, type Edges } from './slice_pane';
import type { Viewer } from '../frame/viewer';
import { colourOf } from '../../store/case/legend/legend';

/** Along right, front and head: the colours of the cross that turns the view. */
const axisColours = [0xb5433b, 0x2c7a4b, 0x2b62ab];

const hasValue = (values: Float32Array) => (voxel: number) => values[voxel] > 0;

/** Whether a voxel of a grid lies in a label that is meshed. */
function meshedVoxels({ size, indexToMm }: Grid): ((voxel: number) => boolean) | undefined {
  const labels = shownResult('volume')?.labels;
  const known = volume.value;
  if (!labels || !known) return undefined;
  const meshed = meshedLabels.value;
  const m = indexMap(indexToMm, known.index_to_mm);
  const [nx, ny, nz] = known.size;
  return (voxel) => {
    const x = voxel % size[0];
    const y = Math.floor(voxel / size[0]) % size[1];
    const z = Math.floor(voxel / (size[0] * size[1]));
    const i = Math.round(m[0] * x + m[1] * y + m[2] * z + m[3]);
    const j = Math.round(m[4] * x + m[5] * y + m[6] * z + m[7]);
    const k = Math.round(m[8] * x + m[9] * y + m[10] * z + m[11]);
    if (i < 0 || j < 0 || k < 0 || i >= nx || j >= ny || k >= nz) return false;
    return meshed.has(labels[i + nx * (j + ny * k)]);
  };
}

const showsPlanes = () => stageShown.value === 'volume' || stageShown.value === 'sizing';

/** What slices show of a body; asked for once they are looked at. */
export interface SlicedBody {
  /** Triangles where its labels meet, nine numbers each. Signals that this reads call for others. */
  borders(): Float32Array;
  elements?: {
    mesh: TetArrays;
    /** The edges of its elements in one slice, over an image of these uniforms. */
    edges(image: Record<string, IUniform>): Edges;
  };
}

export interface SlicesView {
  material: RawShaderMaterial;
  show(body: SlicedBody | null): void;
  dispose(): void;
}

export function addSlices(canvas: Canvas, viewer: Viewer, host: HTMLElement): SlicesView {
  const image = new SliceImage(canvas.renderer.extensions.has('OES_texture_float_linear'));
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const panes = sliceFrames(identity).map((frame) => new SlicePane(canvas, host, image, frame));
  const planes = new Group();
  for (let axis = 0; axis < 3; axis++) {
    const plane = new Mesh(new BufferGeometry(), image.material);
    plane.frustumCulled = false;
    planes.add(plane);
  }
  const cross = new Group();
  for (const color of axisColours) {
    const line = new LineSegments(
      new BufferGeometry(),
      new LineBasicMaterial({ color, transparent: true, opacity: 0.75 }),
    );
    line.frustumCulled = false;
    cross.add(line);
  }
  viewer.add(planes);
  viewer.add(cross);
  const body = signal<SlicedBody | null>(null);

  const moveCross = (places: Vec3) => {
    const { size, indexToMm } = image.grid;
    places.forEach((place, axis) => {
      const corners = image.corners(axis, place).flatMap((corner) => corner.toArray());
      setPositions((planes.children[axis] as Mesh).geometry, Float32Array.from(corners));
      const end = (at: number) =>
        toMm(
          indexToMm,
          places.map((other, i) => (i === axis ? at : Math.round(other * (size[i] - 1)))),
        );
      const line = Float32Array.from([...end(-0.5), ...end(size[axis] - 0.5)]);
      setPositions((cross.children[axis] as LineSegments).geometry, line);
    });
  };

  const stops = [
    effect(() => {
      const labels = shownResult('volume')?.labels;
      const known = untracked(() => volume.value);
      if (!labels || !known || labels.length !== known.size.reduce((product, n) => product * n, 1)) return;
      image.grid = { size: known.size, indexToMm: known.index_to_mm };
      const frames = sliceFrames(known.index_to_mm);
      panes.forEach((pane, i) => pane.setFrame(frames[i]));
      moveCross(slicePlaces.peek());
      canvas.invalidate();
    }),
    // A large image is taken to the graphics card only once a slice of it is looked at.
    effect(() => {
      const labels = shownResult('volume')?.labels;
      const known = untracked(() => volume.value);
      if (!labels || !known || !(showsPlanes() || layout.value === 'slices')) return;
      image.setLabels(labels, image.grid);
      canvas.invalidate();
    }),
    effect(() => {
      const largest = Math.max(0, ...(volume.value?.labels.map(({ label }) => label) ?? []));
      image.setColours(largest, colourOf.value, hiddenLabels.value);
      canvas.invalidate();
    }),
    effect(() => {
      image.setMeshed(volume.value?.labels.map(({ label }) => label) ?? [], meshedLabels.value);
      image.setBackdrop(dark.value ? 0.11 : 0.93);
      canvas.invalidate();
    }),
    effect(() => {
      const painted = paintedVoxels();
      image.setPaint(painted?.labels ?? null, painted?.grid ?? image.grid);
      canvas.invalidate();
    }),
    effect(() => {
      const overlay = layout.value === 'slices' ? sliceOverlay.value : 'labels';
      const wanted = stageShown.value === 'sizing' || overlay !== 'labels';
      const fields = wanted ? sizingFields() : null;
      const thick = overlay === 'thickness' && fields !== null && fields.thickness !== null;
      const field = thick ? fields.thickness : fields?.size;
      image.showSizes(field != null);
      sliceLegend.value = null;
      canvas.invalidate();
      if (!field) return;
      const counts = untracked(() => (thick ? hasValue(field.values) : meshedVoxels(field.grid)));
      const [lo, hi] = robustRange(field.values, counts);
      const title = thick ? 'Wall thickness' : 'Target edge length';
      const shown: Legend = { title, unit: 'mm', map: thick ? 'cividis' : 'viridis', lo, hi };
      image.setField(field, shown, thick);
      sliceLegend.value = shown;
    }),
    effect(() => {
      moveCross(slicePlaces.value);
      planes.visible = showsPlanes();
      cross.visible = layout.value === 'slices' && pointsOf(stageShown.value) !== undefined;
      canvas.invalidate();
    }),
    effect(() => {
      const triangles = layout.value === 'slices' ? body.value?.borders() : undefined;
      for (const pane of panes) pane.setBorders(triangles ?? new Float32Array(0));
      canvas.invalidate();
    }),
    effect(() => {
      const elements = layout.value === 'slices' && showEdges.value ? body.value?.elements : undefined;
      for (const pane of panes)
        pane.setElements(
          elements ? { mesh: elements.mesh, edges: elements.edges(image.material.uniforms) } : null,
        );
      canvas.invalidate();
    }),
  ];

  return {
    material: image.material,
    show(next) {
      body.value = next;
    },
    dispose() {
      for (const stop of stops) stop();
      for (const pane of panes) pane.dispose();
      for (const object of [...planes.children, ...cross.children] as (Mesh | LineSegments)[])
        object.geometry.dispose();
      for (const line of cross.children as LineSegments<BufferGeometry, LineBasicMaterial>[])
        line.material.dispose();
      image.dispose();
    },
  };
}
