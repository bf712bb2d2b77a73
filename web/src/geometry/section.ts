/** Where a plane normal . p = offset cuts a body. */
import type { TetArrays } from '../engine/contract';

/** Ends of the lines in which a plane cuts triangles of nine numbers each: six numbers a line. */
export function sectionLines(
  triangles: Float32Array,
  normal: readonly number[],
  offset: number,
): Float32Array {
  const [nx, ny, nz] = normal;
  const lines: number[] = [];
  for (let t = 0; t < triangles.length; t += 9) {
    const d0 = nx * triangles[t] + ny * triangles[t + 1] + nz * triangles[t + 2] - offset;
    const d1 = nx * triangles[t + 3] + ny * triangles[t + 4] + nz * triangles[t + 5] - offset;
    const d2 = nx * triangles[t + 6] + ny * triangles[t + 7] + nz * triangles[t + 8] - offset;
    const [a0, a1, a2] = [d0 > 0, d1 > 0, d2 > 0];
    if (a0 === a1 && a1 === a2) continue;
    // The corner that is alone on its side; the plane crosses the two edges that meet there.
    const lone = a1 === a2 ? 0 : a0 === a2 ? 1 : 2;
    const d = [d0, d1, d2];
    for (let step = 1; step <= 2; step++) {
      const other = (lone + step) % 3;
      const part = d[lone] / (d[lone] - d[other]);
      const [from, to] = [t + 3 * lone, t + 3 * other];
      for (let axis = 0; axis < 3; axis++)
        lines.push(triangles[from + axis] + part * (triangles[to + axis] - triangles[from + axis]));
    }
  }
  return Float32Array.from(lines);
}

/** Faces of a mesh between two labels, or a label and nothing, nine numbers each; those of hidden labels alone are left out. */
export function borderTriangles(
  { points, tets, labels, neighbours, faces, extents }: TetArrays,
  hidden: ReadonlySet<number>,
): Float32Array {
  const triangles: number[] = [];
  const isShown = (tet: number) => tet >= 0 && !hidden.has(labels[tet]);
  for (let face = 0; face < extents[1]; face++) {
    const half = faces[face];
    const own = half >> 2;
    const other = neighbours[half];
    // Between two labels there are two half-faces.
    if (!isShown(own) || (other < own && isShown(other))) continue;
    for (let k = 0; k < 4; k++) {
      if (k === (half & 3)) continue;
      const p = 3 * tets[4 * own + k];
      triangles.push(points[p], points[p + 1], points[p + 2]);
    }
  }
  return Float32Array.from(triangles);
}

/** Of how many tetrahedra it is asked whether a plane cuts them. */
const asked = 200_000;

/** The median of the mean edge lengths of tetrahedra near a plane, of those whose middle counts; 0 where there are none. */
export function typicalEdge(
  { points, tets, labels, centres, extents }: TetArrays,
  normal: readonly number[],
  offset: number,
  counts: (x: number, y: number, z: number) => boolean,
): number {
  const step = Math.ceil(labels.length / asked);
  const reach = extents[2] / 2;
  const edges: number[] = [];
  for (let t = 0; t < labels.length; t += step) {
    const [x, y, z] = [centres[4 * t], centres[4 * t + 1], centres[4 * t + 2]];
    if (Math.abs(normal[0] * x + normal[1] * y + normal[2] * z - offset) > reach || !counts(x, y, z))
      continue;
    let sum = 0;
    for (let a = 0; a < 4; a++)
      for (let b = 0; b < a; b++) {
        const [p, q] = [3 * tets[4 * t + a], 3 * tets[4 * t + b]];
        sum += Math.hypot(
          points[p] - points[q],
          points[p + 1] - points[q + 1],
          points[p + 2] - points[q + 2],
        );
      }
    edges.push(sum / 6);
  }
  return edges.sort((a, b) => a - b)[edges.length >> 1] ?? 0;
}
