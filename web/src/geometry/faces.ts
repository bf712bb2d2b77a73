import type { SurfaceArrays } from '../engine/contract';

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

/** Triangles that border a shown label, coloured by it. */
export function surfaceFaces(mesh: SurfaceArrays, hidden: ReadonlySet<number>, paint: Painter): Faces {
  const { points, triangles, sides, normals } = mesh;
  const seenAs = new Uint16Array(triangles.length / 3);
  let count = 0;
  let [behind, front, seen] = [-1, -1, 0];
  for (let t = 0; t < seenAs.length; t++) {
    // Neighbours in the list mostly divide the same labels.
    if (behind !== sides[2 * t] || front !== sides[2 * t + 1]) {
      behind = sides[2 * t];
      front = sides[2 * t + 1];
      seen = !hidden.has(behind) ? behind : front > 0 && !hidden.has(front) ? front : 0;
    }
    seenAs[t] = seen;
    if (seen > 0) count++;
  }
  const faces = emptyFaces(count);
  const { positions, owners, colours } = faces;
  if (normals) faces.normals = count === seenAs.length ? normals : new Float32Array(9 * count);
  for (let t = 0, face = 0; t < seenAs.length; t++) {
    if (seenAs[t] === 0) continue;
    for (let c = 0; c < 3; c++) {
      const from = 3 * triangles[3 * t + c];
      const to = 9 * face + 3 * c;
      positions[to] = points[from];
      positions[to + 1] = points[from + 1];
      positions[to + 2] = points[from + 2];
    }
    if (normals && faces.normals !== normals)
      for (let d = 0; d < 9; d++) faces.normals![9 * face + d] = normals[9 * t + d];
    owners[face] = t;
    paint(t, seenAs[t], colours, 9 * face);
    for (let d = 0; d < 3; d++) colours[9 * face + 3 + d] = colours[9 * face + 6 + d] = colours[9 * face + d];
    face++;
  }
  return faces;
}

/** Mean edge length of each triangle, mm. */
export function triangleEdges(points: Float32Array, triangles: Uint32Array): Float32Array {
  const edges = new Float32Array(triangles.length / 3);
  for (let t = 0; t < edges.length; t++) {
    let sum = 0;
    for (let c = 0; c < 3; c++) {
      const a = 3 * triangles[3 * t + c];
      const b = 3 * triangles[3 * t + ((c + 1) % 3)];
      const [x, y, z] = [points[a] - points[b], points[a + 1] - points[b + 1], points[a + 2] - points[b + 2]];
      sum += Math.sqrt(x * x + y * y + z * z);
    }
    edges[t] = sum / 3;
  }
  return edges;
}

/** The centroid of each triangle. */
export function triangleCentres(points: Float32Array, triangles: Uint32Array): Float32Array {
  const centres = new Float32Array(triangles.length);
  for (let i = 0; i < centres.length; i++) {
    const [t, d] = [3 * Math.floor(i / 3), i % 3];
    let sum = 0;
    for (let c = 0; c < 3; c++) sum += points[3 * triangles[t + c] + d];
    centres[i] = sum / 3;
  }
  return centres;
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
