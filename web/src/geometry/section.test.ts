import { expect, it } from 'vitest';
import type { TetArrays } from '../engine/contract';
import { borderTriangles, sectionLines, typicalEdge } from './section';
import { tetFaces } from './tet_faces';
import { tetNeighbours } from './tet_neighbours';

/** Two tetrahedra of labels 1 and 2 with a common face in the plane z = 0. */
function pair(): TetArrays {
  const points = Float32Array.from([0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 1, 0, 0, -1]);
  const tets = Uint32Array.from([0, 1, 2, 3, 0, 2, 1, 4]);
  const bare = { points, tets, labels: Uint16Array.from([1, 2]), neighbours: tetNeighbours(tets, 5) };
  return { ...bare, ...tetFaces(bare) };
}

it('cuts triangles in lines between their edges, and leaves those alone that lie on one side', () => {
  const triangles = Float32Array.from([0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 1, 1, 0, 1, 0, 1, 1]);
  expect([...sectionLines(triangles, [1, 0, 0], 1)]).toEqual([1, 0, 3, 1, 0, 0]);
  expect(sectionLines(triangles, [1, 0, 0], 9)).toHaveLength(0);
});

it('closes the outline of every body: each end of a line is that of one other', () => {
  const lines = sectionLines(borderTriangles(pair(), new Set([2])), [0, 0, 1], 0.25);
  const ends = new Map<string, number>();
  for (let i = 0; i < lines.length; i += 3) {
    const at = [...lines.slice(i, i + 3)].map((x) => x.toFixed(4)).join();
    ends.set(at, (ends.get(at) ?? 0) + 1);
  }
  expect(lines).toHaveLength(18);
  expect([...ends.values()]).toEqual([2, 2, 2]);
});

it('has every face between two labels once, and those of shown labels only', () => {
  const faces = (hidden: number[]) => borderTriangles(pair(), new Set(hidden)).length / 9;
  expect(faces([])).toBe(7);
  expect(faces([2])).toBe(4);
  expect(faces([1, 2])).toBe(0);
});

it('finds the typical edge of the tetrahedra near a plane, where there are some', () => {
  const edges = [3, 4, 1, 5, Math.sqrt(10), Math.sqrt(17)];
  const mean = edges.reduce((sum, edge) => sum + edge, 0) / 6;
  expect(typicalEdge(pair(), [0, 0, 1], 0.2, (_x, _y, z) => z > 0)).toBeCloseTo(mean, 5);
  expect(typicalEdge(pair(), [0, 0, 1], 50, () => true)).toBe(0);
});
