/** Area of a triangle surface, and the volume that it encloses. */
import type { SurfaceArrays } from '../engine/contract';

export type Triangles = Pick<SurfaceArrays, 'points' | 'triangles' | 'sides'>;

/** Sums over triangles of the corners' coordinates. */
function sumOf(
  { points, triangles }: Triangles,
  of: (a: number[], b: number[], c: number[], i: number) => number,
) {
  const corner = (at: number) => {
    const point = 3 * triangles[at];
    return [points[point], points[point + 1], points[point + 2]];
  };
  let sum = 0;
  for (let i = 0; i < triangles.length / 3; i++)
    sum += of(corner(3 * i), corner(3 * i + 1), corner(3 * i + 2), i);
  return sum;
}

function normal(a: number[], b: number[], c: number[]): number[] {
  const [u, v] = [b, c].map((point) => point.map((x, axis) => x - a[axis]));
  return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
}

/** Of the outer boundary and of that between labels. */
export function surfaceMm2(surface: Triangles): number {
  return sumOf(surface, (a, b, c) => Math.hypot(...normal(a, b, c)) / 2);
}

/** Within the outer boundary: of all labels together. */
export function enclosedMm3(surface: Triangles): number {
  const { sides } = surface;
  const signed = sumOf(surface, (a, b, c, i) => {
    const [one, other] = [sides[2 * i], sides[2 * i + 1]];
    if (one > 0 && other > 0) return 0;
    const n = normal(a, b, c);
    return ((one > 0 ? 1 : -1) * (n[0] * a[0] + n[1] * a[1] + n[2] * a[2])) / 6;
  });
  return Math.abs(signed);
}
