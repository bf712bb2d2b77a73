import type { Vec3 } from '../engine/contract';

export type Side = 'R' | 'L' | 'A' | 'P' | 'S' | 'I';
export type SliceName = 'axial' | 'coronal' | 'sagittal';

/** A way of looking at an image across one of its axes. Directions are of unit length, in patient millimetres (RAS). */
export interface SliceFrame {
  name: SliceName;
  /** The image axis that the slice is across. */
  across: 0 | 1 | 2;
  right: Vec3;
  up: Vec3;
  /** Towards the viewer. */
  towards: Vec3;
}

const sides: [Side, Side][] = [
  ['R', 'L'],
  ['A', 'P'],
  ['S', 'I'],
];

function column(indexToMm: readonly number[], axis: number): Vec3 {
  return [indexToMm[axis], indexToMm[4 + axis], indexToMm[8 + axis]];
}

function unit(v: Vec3): Vec3 {
  const length = Math.hypot(...v) || 1;
  return [v[0] / length, v[1] / length, v[2] / length];
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

const orders = [
  [0, 1, 2],
  [0, 2, 1],
  [1, 0, 2],
  [1, 2, 0],
  [2, 0, 1],
  [2, 1, 0],
] as const;

/** The image axes that run closest to right, front and head. */
export function patientAxes(indexToMm: readonly number[]): readonly [0 | 1 | 2, 0 | 1 | 2, 0 | 1 | 2] {
  const directions = [0, 1, 2].map((axis) => unit(column(indexToMm, axis)));
  const fit = (order: readonly number[]) =>
    order.reduce((sum, axis, row) => sum + Math.abs(directions[axis][row]), 0);
  return orders.reduce((best, order) => (fit(order) > fit(best) + 1e-9 ? order : best), orders[0]);
}

/** The three letters of an orientation: where each image axis leads. */
export function orientationLetters(indexToMm: readonly number[]): string {
  const order = patientAxes(indexToMm);
  return [0, 1, 2]
    .map((axis) => {
      const row = order.findIndex((one) => one === axis);
      return sides[row][column(indexToMm, axis)[row] < 0 ? 1 : 0];
    })
    .join('');
}

/** Largest angle between an image axis and the patient's axis that it runs closest to, in degrees. */
export function obliqueness(indexToMm: readonly number[]): number {
  const order = patientAxes(indexToMm);
  return Math.max(
    ...order.map((axis, row) => {
      const along = Math.abs(unit(column(indexToMm, axis))[row]);
      return (Math.acos(Math.min(1, along)) * 180) / Math.PI;
    }),
  );
}

/** The patient's sides that a direction leads to, the nearest first: two letters where it is clearly between them. */
export function sidesOf(direction: Vec3): string {
  const most = Math.max(...direction.map(Math.abs));
  return direction
    .map((part, row) => ({ size: Math.abs(part), side: sides[row][part < 0 ? 1 : 0] }))
    .filter(({ size }) => size > 0.3 * most)
    .sort((a, b) => b.size - a.size)
    .map(({ side }) => side)
    .join('');
}

/** Slices as radiologists look at them: the patient's right on the left, front and head up, profiles to the left. */
export function sliceFrames(indexToMm: readonly number[]): SliceFrame[] {
  const [r, a, s] = patientAxes(indexToMm);
  const towardsSide = (axis: number, row: number, sign: number): Vec3 => {
    const own = unit(column(indexToMm, axis));
    const turn = own[row] * sign < 0 ? -1 : 1;
    return [own[0] * turn, own[1] * turn, own[2] * turn];
  };
  const frame = (name: SliceName, across: 0 | 1 | 2, right: Vec3, up: Vec3): SliceFrame => ({
    name,
    across,
    right,
    up,
    towards: unit(cross(right, up)),
  });
  return [
    frame('axial', s, towardsSide(r, 0, -1), towardsSide(a, 1, 1)),
    frame('coronal', a, towardsSide(r, 0, -1), towardsSide(s, 2, 1)),
    frame('sagittal', r, towardsSide(a, 1, -1), towardsSide(s, 2, 1)),
  ];
}

/** Patient millimetres of a place given in voxels. */
export function toMm(indexToMm: readonly number[], index: readonly number[]): Vec3 {
  return [0, 1, 2].map(
    (row) =>
      indexToMm[4 * row] * index[0] +
      indexToMm[4 * row + 1] * index[1] +
      indexToMm[4 * row + 2] * index[2] +
      indexToMm[4 * row + 3],
  ) as Vec3;
}

/** The place in voxels of patient millimetres. */
export function toIndex(indexToMm: readonly number[], mm: readonly number[]): Vec3 {
  const [a, b, c] = [0, 1, 2].map((axis) => column(indexToMm, axis));
  const det = dot(a, cross(b, c));
  const p: Vec3 = [mm[0] - indexToMm[3], mm[1] - indexToMm[7], mm[2] - indexToMm[11]];
  return [dot(p, cross(b, c)) / det, dot(p, cross(c, a)) / det, dot(p, cross(a, b)) / det];
}

export function dot(a: readonly number[], b: readonly number[]): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The affine map from one grid's indices to another's, 3×4, row-major. */
export function indexMap(from: readonly number[], to: readonly number[]): number[] {
  const origin = toIndex(to, toMm(from, [0, 0, 0]));
  const ends = [0, 1, 2].map((axis) =>
    toIndex(
      to,
      toMm(
        from,
        [0, 1, 2].map((other) => Number(other === axis)),
      ),
    ),
  );
  return origin.flatMap((start, row) => [...ends.map((end) => end[row] - start), start]);
}

/** A coordinate in mm, with a minus sign. */
export const coordinate = (mm: number): string => mm.toFixed(1).replace('-', '−');
