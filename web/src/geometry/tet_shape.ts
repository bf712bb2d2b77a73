/** Shape measures of a tetrahedron, as the engine's report has them (core/geometry/elements, core/quality). */
import type { Vec3 } from '../engine/contract';

export type Corners = readonly [Vec3, Vec3, Vec3, Vec3];

/** Edges as pairs of corners; edge e is opposite to edge 5 - e. */
export const edgesOfTet = [
  [0, 1],
  [0, 2],
  [0, 3],
  [1, 2],
  [1, 3],
  [2, 3],
] as const;

const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const length = (a: Vec3): number => Math.sqrt(dot(a, a));

export interface Sphere {
  centre: Vec3;
  radius: number;
}

export interface TetShape {
  edges: number[];
  /** At the edges, degrees. */
  dihedral: number[];
  inscribed: Sphere;
  circumscribed: Sphere;
  radiusRatio: number;
  meanRatio: number;
  aspectRatio: number;
  scaledJacobian: number;
}

/** Of a tetrahedron that is not flat. */
export function measureTet(p: Corners): TetShape {
  const edges = edgesOfTet.map(([a, b]) => length(minus(p[b], p[a])));
  const [u, v, w] = [minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0])];
  const volume = Math.abs(dot(u, cross(v, w))) / 6;
  const dihedral = edgesOfTet.map(([a, b], e) => {
    const [c, d] = edgesOfTet[5 - e];
    const along = minus(p[b], p[a]);
    const [m, n] = [cross(along, minus(p[c], p[a])), cross(along, minus(p[d], p[a]))];
    return (Math.atan2(length(cross(m, n)), dot(m, n)) * 180) / Math.PI;
  });
  // Of the face opposite to each corner.
  const areas = [
    [1, 2, 3],
    [0, 2, 3],
    [0, 1, 3],
    [0, 1, 2],
  ].map(([a, b, c]) => length(cross(minus(p[b], p[a]), minus(p[c], p[a]))) / 2);
  const surface = areas.reduce((sum, area) => sum + area, 0);
  const inradius = (3 * volume) / surface;
  const centre = [0, 1, 2].map((d) => p.reduce((sum, corner, i) => sum + areas[i] * corner[d], 0) / surface);
  const [vw, wu, uv] = [cross(v, w), cross(w, u), cross(u, v)];
  const determinant = 2 * dot(u, vw);
  const away = [0, 1, 2].map(
    (d) => (dot(u, u) * vw[d] + dot(v, v) * wu[d] + dot(w, w) * uv[d]) / determinant,
  ) as Vec3;
  const circumradius = length(away);
  const products = [
    [0, 1, 2],
    [0, 3, 4],
    [1, 3, 5],
    [2, 4, 5],
  ].map(([a, b, c]) => edges[a] * edges[b] * edges[c]);
  return {
    edges,
    dihedral,
    inscribed: { centre: centre as Vec3, radius: inradius },
    circumscribed: { centre: p[0].map((x, d) => x + away[d]) as Vec3, radius: circumradius },
    radiusRatio: (3 * inradius) / circumradius,
    meanRatio: (12 * Math.cbrt(3 * volume) ** 2) / edges.reduce((sum, edge) => sum + edge * edge, 0),
    aspectRatio: Math.max(...edges) / (2 * Math.sqrt(6) * inradius),
    scaledJacobian: (Math.SQRT2 * 6 * volume) / Math.max(...products),
  };
}

/** From the regular tetrahedron (0) to four points in one plane (1), a sliver on the way. */
export function flattenedTet(flatness: number): Corners {
  const up = (1 - flatness) / Math.SQRT2;
  return [
    [-1, 0, -up],
    [1, 0, -up],
    [0, -1, up],
    [0, 1, up],
  ];
}
