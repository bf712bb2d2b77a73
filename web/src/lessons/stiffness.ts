/**
 * How hard a mesh makes it to solve on it: eigenvalues of the stiffness matrix of Laplace's equation with linear
 * elements, K_ij = ∫ ∇φ_i · ∇φ_j, lengths in mm. K has the constants as its null space (nothing is held fixed); the
 * condition number is that on what is left, the largest eigenvalue over the smallest that is not 0. One flat element
 * makes the largest as large as one likes: Shewchuk, "What is a good linear finite element?" (2002).
 */
import type { TetArrays } from '../engine/contract';

type Tets = Pick<TetArrays, 'points' | 'tets'>;

export interface Spectrum {
  largest: number;
  smallest: number;
  condition: number;
}

/** Larger meshes would hold the page up: this many take about a second. */
export const mostTets = 12_000;

/** A symmetric matrix by rows; entries off the diagonal. */
interface Sparse {
  diagonal: Float64Array;
  starts: Uint32Array;
  columns: Uint32Array;
  values: Float64Array;
}

/** The six entries of one element off its diagonal: −(opposite edge · cot of its angle) / 6, in the order of `pairs`. */
const pairs = [
  [0, 1],
  [0, 2],
  [0, 3],
  [1, 2],
  [1, 3],
  [2, 3],
] as const;

function elementEntries({ points, tets }: Tets, tet: number, entries: Float64Array): void {
  const at = (corner: number, axis: number) => points[3 * tets[4 * tet + corner] + axis];
  const edge = (to: number) => [0, 1, 2].map((axis) => at(to, axis) - at(0, axis));
  const cross = (a: number[], b: number[]) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
  const dot = (a: number[], b: number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const [a, b, c] = [edge(1), edge(2), edge(3)];
  // Gradients of the shape functions times six volumes.
  const gradients = [[0, 0, 0], cross(b, c), cross(c, a), cross(a, b)];
  gradients[0] = [0, 1, 2].map((axis) => -gradients[1][axis] - gradients[2][axis] - gradients[3][axis]);
  const six = Math.abs(dot(a, gradients[1]));
  pairs.forEach(([i, j], k) => (entries[k] = dot(gradients[i], gradients[j]) / (6 * six)));
}

/** The stiffness matrix, its entries gathered by sorting. */
function assemble(mesh: Tets): Sparse {
  const count = mesh.points.length / 3;
  const tetCount = mesh.tets.length / 4;
  const entries = new Float64Array(6);
  const diagonal = new Float64Array(count);
  const rows: Map<number, number>[] = Array.from({ length: count }, () => new Map());
  for (let tet = 0; tet < tetCount; tet++) {
    elementEntries(mesh, tet, entries);
    pairs.forEach(([i, j], k) => {
      const [p, q] = [mesh.tets[4 * tet + i], mesh.tets[4 * tet + j]];
      rows[p].set(q, (rows[p].get(q) ?? 0) + entries[k]);
      rows[q].set(p, (rows[q].get(p) ?? 0) + entries[k]);
      diagonal[p] -= entries[k];
      diagonal[q] -= entries[k];
    });
  }
  const starts = new Uint32Array(count + 1);
  rows.forEach((row, i) => (starts[i + 1] = starts[i] + row.size));
  return {
    diagonal,
    starts,
    columns: Uint32Array.from(rows.flatMap((row) => [...row.keys()])),
    values: Float64Array.from(rows.flatMap((row) => [...row.values()])),
  };
}

function times({ diagonal, starts, columns, values }: Sparse, x: Float64Array): Float64Array {
  const y = new Float64Array(x.length);
  for (let i = 0; i < x.length; i++) {
    let sum = diagonal[i] * x[i];
    for (let k = starts[i]; k < starts[i + 1]; k++) sum += values[k] * x[columns[k]];
    y[i] = sum;
  }
  return y;
}

function dot(a: Float64Array, b: Float64Array): number {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += a[i] * b[i];
  return sum;
}

/** Without its mean, and of length 1. */
function normalised(x: Float64Array): Float64Array {
  let mean = 0;
  for (const value of x) mean += value / x.length;
  const free = x.map((value) => value - mean);
  const length = Math.sqrt(dot(free, free));
  return free.map((value) => value / length);
}

/** The same start on every machine: no two coordinates alike. */
const start = (count: number): Float64Array =>
  normalised(Float64Array.from({ length: count }, (_, i) => Math.sin(1 + 12.9898 * i)));

/** Conjugate gradients with the diagonal as preconditioner, for a right side without mean. */
function solve(matrix: Sparse, b: Float64Array): Float64Array {
  const x = new Float64Array(b.length);
  let r = b.slice();
  let z = r.map((value, i) => value / matrix.diagonal[i]);
  let p = z.slice();
  let rz = dot(r, z);
  for (let step = 0; step < 2000 && dot(r, r) > 1e-16; step++) {
    const q = times(matrix, p);
    const alpha = rz / dot(p, q);
    for (let i = 0; i < x.length; i++) x[i] += alpha * p[i];
    r = r.map((value, i) => value - alpha * q[i]);
    z = r.map((value, i) => value / matrix.diagonal[i]);
    const next = dot(r, z);
    const direction = p;
    p = z.map((value, i) => value + (next / rz) * direction[i]);
    rz = next;
  }
  return x;
}

/** Repeats `apply` until the Rayleigh quotient of what comes out settles. */
function settled(matrix: Sparse, apply: (x: Float64Array) => Float64Array, most: number): number {
  let x = start(matrix.diagonal.length);
  let value = 0;
  for (let step = 0; step < most; step++) {
    x = normalised(apply(x));
    const next = dot(x, times(matrix, x));
    if (Math.abs(next - value) < 1e-7 * next) return next;
    value = next;
  }
  return value;
}

const known = new WeakMap<Uint32Array, Spectrum | null>();

/** Whether every point is reached from the first: else the null space is larger than the constants. */
function isConnected({ diagonal, starts, columns }: Sparse): boolean {
  const seen = new Uint8Array(diagonal.length);
  const waiting = [0];
  let count = 0;
  seen[0] = 1;
  for (let row = waiting.pop(); row !== undefined; row = waiting.pop()) {
    count++;
    for (let k = starts[row]; k < starts[row + 1]; k++)
      if (!seen[columns[k]]) {
        seen[columns[k]] = 1;
        waiting.push(columns[k]);
      }
  }
  return count === diagonal.length;
}

/**
 * Null where the mesh is too large to ask, is not in one piece, or has an element without volume. The same mesh is
 * worked on once.
 */
export function spectrumOf(mesh: Tets): Spectrum | null {
  if (mesh.tets.length / 4 > mostTets) return null;
  const before = known.get(mesh.tets);
  if (before !== undefined) return before;
  const found = spectrum(assemble(mesh));
  known.set(mesh.tets, found);
  return found;
}

function spectrum(matrix: Sparse): Spectrum | null {
  if (!matrix.diagonal.every(Number.isFinite) || !isConnected(matrix)) return null;
  const largest = settled(matrix, (x) => times(matrix, x), 3000);
  const smallest = settled(matrix, (x) => solve(matrix, x), 40);
  return { largest, smallest, condition: largest / smallest };
}
