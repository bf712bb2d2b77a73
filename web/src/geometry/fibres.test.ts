import { describe, expect, it } from 'vitest';
import { helixAngles } from './helix_angles';
import {
  cellSize,
  evenlySpread,
  glyphPieces,
  tracedLines,
  walkTo,
  type FibreField,
  type Pieces,
} from './fibres';
import { tetFaces } from './tet_faces';
import { tetNeighbours } from './tet_neighbours';

/** A box of `n` cubes of 1 mm along each axis, six tetrahedra a cube, its middle at 0. */
function box(n: number) {
  const points: number[] = [];
  const at = (i: number, j: number, k: number) => i + (n + 1) * (j + (n + 1) * k);
  for (let k = 0; k <= n; k++)
    for (let j = 0; j <= n; j++) for (let i = 0; i <= n; i++) points.push(i - n / 2, j - n / 2, k - n / 2);
  const tets: number[] = [];
  const ways = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [1, 0, 2],
    [0, 2, 1],
    [2, 1, 0],
  ];
  for (let k = 0; k < n; k++)
    for (let j = 0; j < n; j++)
      for (let i = 0; i < n; i++)
        ways.forEach((way, odd) => {
          const corner = [i, j, k];
          const path = [at(i, j, k)];
          for (const axis of way) {
            corner[axis]++;
            path.push(at(corner[0], corner[1], corner[2]));
          }
          if (odd >= 3) [path[2], path[3]] = [path[3], path[2]];
          tets.push(...path);
        });
  const bare = {
    points: Float32Array.from(points),
    tets: Uint32Array.from(tets),
    labels: new Uint16Array(tets.length / 4).fill(1),
  };
  const mesh = { ...bare, neighbours: tetNeighbours(bare.tets, points.length / 3) };
  return { ...mesh, ...tetFaces(mesh) };
}

type Way = (x: number, y: number, z: number) => number[];

function fieldOf(mesh: ReturnType<typeof box>, way: Way, shows = (_: number) => true): FibreField {
  const fibre = new Float32Array(3 * mesh.labels.length);
  for (let t = 0; t < mesh.labels.length; t++) {
    const [x, y, z] = mesh.centres.subarray(4 * t, 4 * t + 3);
    fibre.set(way(x, y, z), 3 * t);
  }
  return { mesh, fibre, shows };
}

/** What comes of work that lets others go in between. */
function whole<T>(work: Generator<void, T, void>): T {
  for (;;) {
    const { done, value } = work.next();
    if (done) return value;
  }
}

const traced = (field: FibreField, spacing: number, longest: number): Pieces =>
  whole(tracedLines(field, { spacing, longest }));

/** Whether pieces go on where the one before ended: lines as lists of places. */
function linesOf({ ends }: Pieces): number[][][] {
  const lines: number[][][] = [];
  for (let i = 0; i < ends.length; i += 6) {
    const [from, to] = [[...ends.subarray(i, i + 3)], [...ends.subarray(i + 3, i + 6)]];
    const last = lines.at(-1)?.at(-1);
    if (last?.every((x, d) => x === from[d])) lines.at(-1)?.push(to);
    else lines.push([from, to]);
  }
  return lines;
}

const mesh = box(8);
const alongX: Way = () => [1, 0, 0];

describe('glyphs', () => {
  it('are about as many as asked for, one a cube, of a length, in the middle of their tetrahedra', () => {
    const field = fieldOf(mesh, alongX);
    const size = whole(cellSize(field, 64));
    expect(size).toBeCloseTo(2, 5);
    const tets = whole(evenlySpread(field, size));
    expect(tets.length).toBe(64);
    const { ends } = glyphPieces(field, tets, 1.5);
    for (let i = 0; i < tets.length; i++) {
      expect(ends[6 * i + 3] - ends[6 * i]).toBeCloseTo(1.5, 5);
      for (let d = 0; d < 3; d++)
        expect((ends[6 * i + d] + ends[6 * i + 3 + d]) / 2).toBeCloseTo(mesh.centres[4 * tets[i] + d], 5);
    }
  });

  it('are not where there is no muscle, nor where nothing is shown', () => {
    const half = fieldOf(
      mesh,
      (x) => (x < 0 ? [1, 0, 0] : [0, 0, 0]),
      (tet) => mesh.centres[4 * tet + 1] < 0,
    );
    const tets = whole(evenlySpread(half, 1));
    expect(tets.length).toBe(4 * 4 * 8);
    for (const tet of tets) {
      expect(mesh.centres[4 * tet]).toBeLessThan(0);
      expect(mesh.centres[4 * tet + 1]).toBeLessThan(0);
    }
  });
});

describe('the way through tetrahedra', () => {
  it('ends in the one that holds the place, and below 0 outside', () => {
    const tet = walkTo(mesh, 0, [3.3, 2.1, -1.7]);
    for (let d = 0; d < 3; d++)
      expect(Math.abs(mesh.centres[4 * tet + d] - [3.3, 2.1, -1.7][d])).toBeLessThan(1);
    expect(walkTo(mesh, 0, [0, 0, 4.1])).toBe(-1);
  });
});

describe('lines', () => {
  it('of a straight field go from one side to the other, whatever the signs of its vectors', () => {
    const field = fieldOf(mesh, (x, y, z) => [Math.sin(40 * x + 7 * y + 3 * z) < 0 ? -1 : 1, 0, 0]);
    const lines = linesOf(traced(field, 2, 100));
    expect(lines).toHaveLength(16);
    for (const line of lines) {
      const along = line.map(([x]) => x);
      expect(Math.max(...along) - Math.min(...along)).toBeGreaterThan(8 - 2 * (2 / 3));
      for (const [, y, z] of line) {
        expect(y).toBeCloseTo(line[0][1], 4);
        expect(z).toBeCloseTo(line[0][2], 4);
      }
    }
  });

  it('of a field around an axis stay on their circles', () => {
    const field = fieldOf(box(16), (x, y) => [-y / Math.hypot(x, y), x / Math.hypot(x, y), 0]);
    const lines = linesOf(traced(field, 2, 12));
    let checked = 0;
    for (const line of lines) {
      const radii = line.map(([x, y]) => Math.hypot(x, y));
      // Within a cell or two of the axis a field of one vector a tetrahedron has no circles.
      if (Math.min(...radii) < 4) continue;
      checked++;
      expect(Math.max(...radii) - Math.min(...radii)).toBeLessThan(0.35);
    }
    expect(checked).toBeGreaterThan(20);
  });

  it('are no longer than asked for to either side', () => {
    const lines = linesOf(traced(fieldOf(mesh, alongX), 2, 2));
    expect(lines.length).toBeGreaterThanOrEqual(16);
    for (const line of lines) expect(line.at(-1)![0] - line[0][0]).toBeLessThanOrEqual(4 + 1e-4);
  });
});

describe('the helix angle', () => {
  /** A wall whose outside is at high x and whose base is at high z: the way around, counterclockwise from above, is y. */
  const values = (axis: number) => mesh.points.filter((_, i) => i % 3 === axis);
  const angleOf = (way: number[]) => {
    const { fibre } = fieldOf(mesh, () => way);
    const all = helixAngles(mesh, fibre, values(0), values(2));
    expect(new Set(all.map((one) => Math.round(one * 100) / 100)).size).toBe(1);
    return all[0];
  };

  it('is that of the part along the wall, from -90 to 90, whatever the sign of the fibre', () => {
    const [s, c] = [Math.sin(Math.PI / 3), 0.5];
    expect(angleOf([0, 1, 0])).toBeCloseTo(0, 4);
    expect(angleOf([0, c, s])).toBeCloseTo(60, 4);
    expect(angleOf([0, -c, -s])).toBeCloseTo(60, 4);
    expect(angleOf([0, c, -s])).toBeCloseTo(-60, 4);
    expect(angleOf([0, 0, 1])).toBeCloseTo(90, 4);
    expect(angleOf([s, c * Math.SQRT1_2, c * Math.SQRT1_2])).toBeCloseTo(45, 4);
  });

  it('is none where there is no fibre', () => {
    expect(helixAngles(mesh, new Float32Array(3 * mesh.labels.length), values(0), values(2))[5]).toBeNaN();
  });
});
