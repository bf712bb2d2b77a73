/** Regions as distances: what the engine uses, and what slices draw and drag. */
import type { SizeRegion, Vec3 } from '../engine/contract';

/** A sphere, box or capsule in the patient, whatever it is for. */
export type Region = Pick<
  SizeRegion,
  'shape' | 'centre_mm' | 'end_mm' | 'half_size_mm' | 'axes_deg' | 'radius_mm'
>;

const sub = (a: readonly number[], b: readonly number[]): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const add = (a: readonly number[], b: readonly number[]): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const dot = (a: readonly number[], b: readonly number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** A box's own axes: turned about x, then y, then z, all fixed. */
function boxAxes(degrees: Vec3): [Vec3, Vec3, Vec3] {
  const [x, y, z] = degrees.map((angle) => (angle * Math.PI) / 180);
  const turned = (v: Vec3): Vec3 => {
    let [a, b, c] = v;
    [b, c] = [b * Math.cos(x) - c * Math.sin(x), b * Math.sin(x) + c * Math.cos(x)];
    [a, c] = [a * Math.cos(y) + c * Math.sin(y), c * Math.cos(y) - a * Math.sin(y)];
    [a, b] = [a * Math.cos(z) - b * Math.sin(z), a * Math.sin(z) + b * Math.cos(z)];
    return [a, b, c];
  };
  return [turned([1, 0, 0]), turned([0, 1, 0]), turned([0, 0, 1])];
}

function boxCoordinates(region: Region, point: readonly number[]): Vec3 {
  const away = sub(point, region.centre_mm);
  return boxAxes(region.axes_deg).map((axis) => dot(axis, away)) as Vec3;
}

/** Millimetres from a region's surface, negative inside. */
export function regionDistance(region: Region, point: readonly number[]): number {
  switch (region.shape) {
    case 'sphere':
      return Math.hypot(...sub(point, region.centre_mm)) - region.radius_mm;
    case 'capsule': {
      const along = sub(region.end_mm, region.centre_mm);
      const away = sub(point, region.centre_mm);
      const t = Math.max(0, Math.min(1, dot(away, along) / (dot(along, along) || 1)));
      return Math.hypot(...sub(away, along.map((x) => t * x) as Vec3)) - region.radius_mm;
    }
    case 'box': {
      const beyond = boxCoordinates(region, point).map((x, i) => Math.abs(x) - region.half_size_mm[i]);
      const outside = Math.hypot(...beyond.map((x) => Math.max(0, x)));
      return outside + Math.min(0, Math.max(...beyond));
    }
  }
}

const rounded = (v: Vec3): Vec3 => v.map((x) => Math.round(100 * x) / 100) as Vec3;
const positive = (x: number) => Math.max(0.1, Math.round(100 * x) / 100);

export function movedRegion(region: Region, by: readonly number[]): Partial<Region> {
  const centre_mm = rounded(add(region.centre_mm, by));
  return region.shape === 'capsule' ? { centre_mm, end_mm: rounded(add(region.end_mm, by)) } : { centre_mm };
}

/** The region with its surface pulled from one place to another: a radius, or that side of a box. */
export function pulledRegion(
  region: Region,
  from: readonly number[],
  to: readonly number[],
): Partial<Region> {
  if (region.shape !== 'box') {
    const change = regionDistance(region, to) - regionDistance(region, from);
    return { radius_mm: positive(region.radius_mm + change) };
  }
  const start = boxCoordinates(region, from);
  const beyond = start.map((x, i) => Math.abs(x) - region.half_size_mm[i]);
  const side = beyond.indexOf(Math.max(...beyond));
  const end = boxCoordinates(region, to);
  const half_size_mm = region.half_size_mm.map((half, i) =>
    i === side ? positive(half + Math.abs(end[i]) - Math.abs(start[i])) : half,
  ) as Vec3;
  return { half_size_mm };
}

/** Where a function of the plane is zero, as line pieces x1, y1, x2, y2, from its values on a lattice of `step`. */
export function zeroLines(
  value: (x: number, y: number) => number,
  width: number,
  height: number,
  step: number,
): number[] {
  const columns = Math.ceil(width / step) + 1;
  const rows = Math.ceil(height / step) + 1;
  const values = Float64Array.from({ length: columns * rows }, (_, i) =>
    value((i % columns) * step, Math.floor(i / columns) * step),
  );
  const lines: number[] = [];
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const corners = [
        [column, row],
        [column + 1, row],
        [column + 1, row + 1],
        [column, row + 1],
      ];
      const crossings: number[] = [];
      corners.forEach(([x, y], i) => {
        const [nextX, nextY] = corners[(i + 1) % 4];
        const a = values[y * columns + x];
        const b = values[nextY * columns + nextX];
        if (a < 0 === b < 0) return;
        const t = a / (a - b);
        crossings.push(step * (x + t * (nextX - x)), step * (y + t * (nextY - y)));
      });
      for (let i = 0; i + 3 < crossings.length; i += 4) lines.push(...crossings.slice(i, i + 4));
    }
  }
  return lines;
}
