import { oppositeFace } from './tet_neighbours';

/** Triangles as the scene draws them: three corners a face, one colour a corner, one owner a face. */
export interface Faces {
  positions: Float32Array;
  colours: Uint8Array;
  /** Per corner, or nothing for flat shading. */
  normals?: Float32Array;
  /** The tet or triangle that each face belongs to. */
  owners: Uint32Array;
}

/** Writes the RGB (0..255) of element `element` seen from label `label` into out[at..at+2]. */
export type Painter = (element: number, label: number, out: Uint8Array, at: number) => void;

export interface TetFilter {
  /** Keep tets whose centroid c has normal . c <= offset. */
  plane?: { normal: readonly number[]; offset: number };
  hidden: ReadonlySet<number>;
  /** Keep tets within a range of these values, any of the arrays. */
  ranges?: { values: Float32Array[]; lo: number; hi: number };
  /** Keep tets whose centroid lies within a ball. */
  ball?: { centre: readonly number[]; radius: number };
}

/** One byte a tet: 1 where the filter keeps it. */
export function keptTets(
  points: Float32Array,
  tets: Uint32Array,
  labels: Uint16Array,
  filter: TetFilter,
): { kept: Uint8Array; count: number } {
  const kept = new Uint8Array(labels.length);
  const { plane, ranges, ball, hidden } = filter;
  let count = 0;
  for (let t = 0; t < labels.length; t++) {
    if (hidden.size > 0 && hidden.has(labels[t])) continue;
    if (ranges && !ranges.values.some((values) => values[t] >= ranges.lo && values[t] <= ranges.hi)) continue;
    if (plane || ball) {
      let x = 0;
      let y = 0;
      let z = 0;
      for (let k = 0; k < 4; k++) {
        const p = 3 * tets[4 * t + k];
        x += points[p];
        y += points[p + 1];
        z += points[p + 2];
      }
      x /= 4;
      y /= 4;
      z /= 4;
      if (plane && plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z > plane.offset) continue;
      if (ball) {
        const [cx, cy, cz] = ball.centre;
        if ((x - cx) ** 2 + (y - cy) ** 2 + (z - cz) ** 2 > ball.radius ** 2) continue;
      }
    }
    kept[t] = 1;
    count++;
  }
  return { kept, count };
}

/** Outer faces of the kept tets, whole elements and nothing cut; normals point out. */
export function outerFaces(
  mesh: { points: Float32Array; tets: Uint32Array; labels: Uint16Array; neighbours: Int32Array },
  kept: Uint8Array,
  paint: Painter,
): Faces {
  const { points, tets, labels, neighbours } = mesh;
  let count = 0;
  for (let t = 0; t < kept.length; t++) {
    if (!kept[t]) continue;
    for (let k = 0; k < 4; k++) {
      const other = neighbours[4 * t + k];
      if (other < 0 || !kept[other]) count++;
    }
  }
  const faces = emptyFaces(count);
  let face = 0;
  for (let t = 0; t < kept.length; t++) {
    if (!kept[t]) continue;
    for (let k = 0; k < 4; k++) {
      const other = neighbours[4 * t + k];
      if (other >= 0 && kept[other]) continue;
      const corners = oppositeFace[k];
      for (let c = 0; c < 3; c++) copyPoint(points, tets[4 * t + corners[c]], faces.positions, 3 * face + c);
      paintFace(faces, face, t, labels[t], paint);
      face++;
    }
  }
  return faces;
}

export interface SurfaceFilter {
  hidden: ReadonlySet<number>;
  /** Normals averaged between triangles of the same pair of labels, for surfaces finer than the eye follows. */
  smooth: boolean;
}

/** Triangles that border a shown label, coloured by it. */
export function surfaceFaces(
  mesh: { points: Float32Array; triangles: Uint32Array; sides: Uint16Array },
  filter: SurfaceFilter,
  paint: Painter,
): Faces {
  const { points, triangles, sides } = mesh;
  const shown: number[] = [];
  const seenAs: number[] = [];
  for (let t = 0; t < triangles.length / 3; t++) {
    const behind = sides[2 * t];
    const front = sides[2 * t + 1];
    const label = !filter.hidden.has(behind) ? behind : front > 0 && !filter.hidden.has(front) ? front : 0;
    if (label === 0) continue;
    shown.push(t);
    seenAs.push(label);
  }
  const faces = emptyFaces(shown.length);
  shown.forEach((t, face) => {
    for (let c = 0; c < 3; c++) copyPoint(points, triangles[3 * t + c], faces.positions, 3 * face + c);
    paintFace(faces, face, t, seenAs[face], paint);
  });
  if (filter.smooth) faces.normals = smoothNormals(mesh, faces);
  return faces;
}

function smoothNormals(
  mesh: { points: Float32Array; triangles: Uint32Array; sides: Uint16Array },
  faces: Faces,
): Float32Array {
  const { triangles, sides } = mesh;
  const normals = new Float32Array(faces.positions.length);
  const sums = new Float32Array(mesh.points.length);
  const pairOf = (face: number) => sides[2 * faces.owners[face]] * 65536 + sides[2 * faces.owners[face] + 1];
  const order = Uint32Array.from(faces.owners.keys()).sort((a, b) => pairOf(a) - pairOf(b));
  for (let from = 0; from < order.length;) {
    let to = from;
    while (to < order.length && pairOf(order[to]) === pairOf(order[from])) to++;
    const group = order.subarray(from, to);
    const cornersOf = (face: number, c: number) => 3 * triangles[3 * faces.owners[face] + c];
    for (const face of group)
      for (let c = 0; c < 3; c++) sums.fill(0, cornersOf(face, c), cornersOf(face, c) + 3);
    for (const face of group) {
      const [nx, ny, nz] = areaNormal(faces.positions, 9 * face);
      for (let c = 0; c < 3; c++) {
        const p = cornersOf(face, c);
        sums[p] += nx;
        sums[p + 1] += ny;
        sums[p + 2] += nz;
      }
    }
    for (const face of group) {
      for (let c = 0; c < 3; c++) {
        const p = cornersOf(face, c);
        const length = Math.hypot(sums[p], sums[p + 1], sums[p + 2]) || 1;
        for (let d = 0; d < 3; d++) normals[9 * face + 3 * c + d] = sums[p + d] / length;
      }
    }
    from = to;
  }
  return normals;
}

function areaNormal(p: Float32Array, at: number): [number, number, number] {
  const ax = p[at + 3] - p[at];
  const ay = p[at + 4] - p[at + 1];
  const az = p[at + 5] - p[at + 2];
  const bx = p[at + 6] - p[at];
  const by = p[at + 7] - p[at + 1];
  const bz = p[at + 8] - p[at + 2];
  return [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
}

/** Mean edge length of each triangle, mm. */
export function triangleEdges(points: Float32Array, triangles: Uint32Array): Float32Array {
  const edges = new Float32Array(triangles.length / 3);
  for (let t = 0; t < edges.length; t++) {
    let sum = 0;
    for (let c = 0; c < 3; c++) {
      const a = 3 * triangles[3 * t + c];
      const b = 3 * triangles[3 * t + ((c + 1) % 3)];
      sum += Math.hypot(points[a] - points[b], points[a + 1] - points[b + 1], points[a + 2] - points[b + 2]);
    }
    edges[t] = sum / 3;
  }
  return edges;
}

/** The values that bound the middle 98 % of finite entries, from a sample of at most 20,000. */
export function robustRange(values: Float32Array): [number, number] {
  const step = Math.max(1, Math.floor(values.length / 20000));
  const sample: number[] = [];
  for (let i = 0; i < values.length; i += step) if (Number.isFinite(values[i])) sample.push(values[i]);
  if (sample.length === 0) return [0, 1];
  sample.sort((a, b) => a - b);
  const lo = sample[Math.floor(0.01 * (sample.length - 1))];
  const hi = sample[Math.ceil(0.99 * (sample.length - 1))];
  return hi > lo ? [lo, hi] : [lo - 0.5, lo + 0.5];
}

function emptyFaces(count: number): Faces {
  return {
    positions: new Float32Array(9 * count),
    colours: new Uint8Array(9 * count),
    owners: new Uint32Array(count),
  };
}

function copyPoint(points: Float32Array, point: number, out: Float32Array, corner: number): void {
  out[3 * corner] = points[3 * point];
  out[3 * corner + 1] = points[3 * point + 1];
  out[3 * corner + 2] = points[3 * point + 2];
}

function paintFace(faces: Faces, face: number, owner: number, label: number, paint: Painter): void {
  faces.owners[face] = owner;
  const at = 9 * face;
  paint(owner, label, faces.colours, at);
  faces.colours.copyWithin(at + 3, at, at + 3);
  faces.colours.copyWithin(at + 6, at, at + 3);
}
