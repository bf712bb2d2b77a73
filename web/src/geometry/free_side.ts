import type { TetArrays, Vec3 } from '../engine/contract';

const directionCount = 96;
/** How far before the element material counts, and around the line of sight, in sizes of the element. */
const reach = 12;
const around = 1.2;

/** Directions evenly spread over a sphere, on a spiral by the golden angle. */
function directions(): Vec3[] {
  return Array.from({ length: directionCount }, (_, i) => {
    const z = 1 - (2 * i + 1) / directionCount;
    const ring = Math.sqrt(1 - z * z);
    const turn = i * Math.PI * (3 - Math.sqrt(5));
    return [ring * Math.cos(turn), ring * Math.sin(turn), z];
  });
}

const minus = (a: ArrayLike<number>, b: ArrayLike<number>): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

type Tets = Pick<TetArrays, 'points' | 'tets' | 'centres'>;

function cornersOf({ points, tets }: Tets, tet: number): Vec3[] {
  return [0, 1, 2, 3].map((k) => {
    const p = 3 * tets[4 * tet + k];
    return [points[p], points[p + 1], points[p + 2]];
  });
}

/** Four times the area in which each direction sees a tetrahedron. */
function seenAreas([a, b, c, d]: Vec3[], from: readonly Vec3[]): number[] {
  const faces = [
    cross(minus(b, a), minus(c, a)),
    cross(minus(c, a), minus(d, a)),
    cross(minus(d, a), minus(b, a)),
    cross(minus(c, b), minus(d, b)),
  ];
  return from.map((way) => faces.reduce((sum, face) => sum + Math.abs(dot(face, way)), 0));
}

/** The direction from which a tetrahedron is seen best: with little material before it, and its broad side in front. */
export function freeSide(mesh: Tets, tet: number, hidden: ReadonlySet<number>): Vec3 {
  const ways = directions();
  const corners = cornersOf(mesh, tet);
  const areas = seenAreas(corners, ways);
  const size = Math.max(...corners.map((corner) => Math.hypot(...minus(corner, corners[0]))));
  const centre = mesh.centres.subarray(4 * tet, 4 * tet + 3);
  const before = new Float64Array(ways.length);
  for (let t = 0; 4 * t < mesh.centres.length; t++) {
    if (t === tet || hidden.has(mesh.centres[4 * t + 3])) continue;
    const away = minus(mesh.centres.subarray(4 * t, 4 * t + 3), centre);
    const square = dot(away, away);
    if (square > (reach * size) ** 2) continue;
    const [a, b, c, d] = cornersOf(mesh, t);
    const volume = Math.abs(dot(minus(d, a), cross(minus(b, a), minus(c, a)))) / 6;
    ways.forEach((way, i) => {
      const along = dot(away, way);
      if (along > 0 && square - along * along < (around * size) ** 2) before[i] += volume;
    });
  }
  // As a share of the whole way: 0 is free, 1 is full of material.
  const full = Math.PI * around ** 2 * reach * size ** 3;
  const broadest = Math.max(...areas);
  const cost = ways.map((_, i) => before[i] / full + 0.5 * (1 - areas[i] / broadest));
  return ways[cost.indexOf(Math.min(...cost))];
}
