/** Triangles as the scene draws them: three corners a face, one colour a corner, one owner a face. */
export interface Faces {
  positions: Float32Array;
  colours: Uint8Array;
  /** Per corner, or nothing for flat shading. */
  normals?: Float32Array;
  /** The triangle that each face is. */
  owners: Uint32Array;
}

/** Writes the RGB (0..255) of triangle `element` seen from label `label` into out[at..at+2]. */
export type Painter = (element: number, label: number, out: Uint8Array, at: number) => void;

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

/** The values that bound the middle 98 % of finite entries that count, from a sample of some 20,000 at most. */
export function robustRange(values: Float32Array, counts?: (index: number) => boolean): [number, number] {
  const step = Math.max(1, Math.floor(values.length / 20000));
  const sample: number[] = [];
  for (let i = 0; i < values.length; i += step)
    if (Number.isFinite(values[i]) && (!counts || counts(i))) sample.push(values[i]);
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
