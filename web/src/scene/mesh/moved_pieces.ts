/** Pieces that lie within tetrahedra follow them when their points move. */
import type { Pieces } from '../../geometry/fibres';

interface Mesh {
  points: Float32Array;
  tets: Uint32Array;
}

type Vector = [number, number, number];

const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Four numbers an end of a piece: how much of each corner of its tetrahedron it is made of. */
export function endWeights({ points, tets }: Mesh, pieces: Pieces): Float32Array {
  const weights = new Float32Array(8 * pieces.tets.length);
  pieces.tets.forEach((tet, piece) => {
    const corner = (k: number) => 3 * tets[4 * tet + k];
    const from = (k: number): Vector => {
      const [p, o] = [corner(k), corner(0)];
      return [points[p] - points[o], points[p + 1] - points[o + 1], points[p + 2] - points[o + 2]];
    };
    const [a, b, c] = [from(1), from(2), from(3)];
    const [ab, bc, ca] = [cross(a, b), cross(b, c), cross(c, a)];
    const volume = dot(a, bc);
    for (const end of [0, 1]) {
      const e = 6 * piece + 3 * end;
      const p = [0, 1, 2].map((d) => pieces.ends[e + d] - points[corner(0) + d]) as Vector;
      const shares = [dot(p, bc) / volume, dot(p, ca) / volume, dot(p, ab) / volume];
      weights.set([1 - shares[0] - shares[1] - shares[2], ...shares], 8 * piece + 4 * end);
    }
  });
  return weights;
}

/** The ends of the pieces when each point has moved by three numbers. */
export function movedEnds(
  tets: Uint32Array,
  pieces: Pieces,
  weights: Float32Array,
  moves: Float32Array,
): Float32Array {
  const ends = pieces.ends.slice();
  for (let end = 0; end < 2 * pieces.tets.length; end++)
    for (let k = 0; k < 4; k++) {
      const point = 3 * tets[4 * pieces.tets[end >> 1] + k];
      for (let d = 0; d < 3; d++) ends[3 * end + d] += weights[4 * end + k] * moves[point + d];
    }
  return ends;
}
