import type { TetArrays } from '../engine/contract';

type Mesh = Pick<TetArrays, 'points' | 'tets'>;

/** Three numbers to write to. */
type Out = Float64Array;

/** Along the gradient of a value at points within a tetrahedron that is the right way round. */
function gradient({ points, tets }: Mesh, tet: number, values: Float32Array, out: Out): void {
  const a = tets[4 * tet];
  out.fill(0);
  for (let k = 1; k < 4; k++) {
    const rise = values[tets[4 * tet + k]] - values[a];
    const v = tets[4 * tet + (k === 3 ? 1 : k + 1)];
    const w = tets[4 * tet + (k === 1 ? 3 : k - 1)];
    const vx = points[3 * v] - points[3 * a];
    const vy = points[3 * v + 1] - points[3 * a + 1];
    const vz = points[3 * v + 2] - points[3 * a + 2];
    const wx = points[3 * w] - points[3 * a];
    const wy = points[3 * w + 1] - points[3 * a + 1];
    const wz = points[3 * w + 2] - points[3 * a + 2];
    out[0] += rise * (vy * wz - vz * wy);
    out[1] += rise * (vz * wx - vx * wz);
    out[2] += rise * (vx * wy - vy * wx);
  }
}

function cross(a: Out, b: Out, out: Out): void {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

const dot = (a: Out, b: Out) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/**
 * The helix angle of each tetrahedron's fibre, degrees, more than -90 to 90; NaN where there is none: between the fibre's
 * part along the wall and the direction around the heart, positive where it climbs to the base while it goes
 * counterclockwise, seen from there. `depth` and `height` are values at points: of the depth in the wall from the inside
 * out, and of the way from apex to base. The convention is that of Bayer et al., Annals of Biomedical Engineering 40
 * (2012).
 */
export function helixAngles(
  mesh: Mesh,
  fibre: Float32Array,
  depth: Float32Array,
  height: Float32Array,
): Float32Array<ArrayBuffer> {
  const angles = new Float32Array(mesh.tets.length / 4).fill(NaN);
  const [way, outwards, rise, around, up] = Array.from({ length: 5 }, () => new Float64Array(3));
  for (let tet = 0; tet < angles.length; tet++) {
    for (let d = 0; d < 3; d++) way[d] = fibre[3 * tet + d];
    gradient(mesh, tet, depth, outwards);
    gradient(mesh, tet, height, rise);
    cross(rise, outwards, around);
    cross(outwards, around, up);
    const size = Math.sqrt(dot(around, around));
    if (dot(way, way) === 0 || !(size > 0)) continue;
    const [along, across] = [dot(way, up) / Math.sqrt(dot(up, up)), dot(way, around) / size];
    const angle = Math.atan2(along, across) * (180 / Math.PI);
    angles[tet] = angle > 90 ? angle - 180 : angle <= -90 ? angle + 180 : angle;
  }
  return angles;
}
