import type { TetArrays } from '../engine/contract';

type Vector = [number, number, number];

const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The gradient of a value at points within a tetrahedron, times six of its volume. */
function gradient(
  { points, tets }: Pick<TetArrays, 'points' | 'tets'>,
  tet: number,
  values: Float32Array,
): Vector {
  const [a, b, c, d] = tets.subarray(4 * tet, 4 * tet + 4);
  const edge = (to: number): Vector => [
    points[3 * to] - points[3 * a],
    points[3 * to + 1] - points[3 * a + 1],
    points[3 * to + 2] - points[3 * a + 2],
  ];
  const [u, v, w] = [edge(b), edge(c), edge(d)];
  const parts = [cross(v, w), cross(w, u), cross(u, v)];
  const rises = [values[b] - values[a], values[c] - values[a], values[d] - values[a]];
  return [0, 1, 2].map((x) => parts.reduce((sum, part, i) => sum + rises[i] * part[x], 0)) as Vector;
}

/**
 * The helix angle of each tetrahedron's fibre, degrees, more than -90 to 90; NaN where there is none: between the fibre's
 * part along the wall and the direction around the heart, positive where it climbs to the base while it goes
 * counterclockwise, seen from there. `depth` and `height` are values at points: of the depth in the wall from the inside
 * out, and of the way from apex to base. The convention is that of Bayer et al., Annals of Biomedical Engineering 40
 * (2012).
 */
export function helixAngles(
  mesh: Pick<TetArrays, 'points' | 'tets'>,
  fibre: Float32Array,
  depth: Float32Array,
  height: Float32Array,
): Float32Array<ArrayBuffer> {
  return Float32Array.from({ length: mesh.tets.length / 4 }, (_, tet) => {
    const way = [...fibre.subarray(3 * tet, 3 * tet + 3)] as Vector;
    const outwards = gradient(mesh, tet, depth);
    const rise = gradient(mesh, tet, height);
    const around = cross(rise, outwards);
    const up = cross(outwards, around);
    const size = Math.hypot(...around);
    if (dot(way, way) === 0 || !(size > 0)) return NaN;
    const angle = Math.atan2(dot(way, up) / Math.hypot(...up), dot(way, around) / size) * (180 / Math.PI);
    return angle > 90 ? angle - 180 : angle <= -90 ? angle + 180 : angle;
  });
}
