import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import createVoxtet from '../engine/testing/mock_engine.mjs';
import { colourTable, labelColour } from './colours';
import { keptTets, outerFaces, robustRange, surfaceFaces } from './faces';
import { coveringRange, rebin } from './histogram';
import { oppositeFace, tetNeighbours } from './tet_neighbours';

/** The ball of the mock engine: 2,760 tetrahedra of two labels. */
async function ball() {
  const engine = await createVoxtet();
  const session = new engine.Session();
  session.setRecipe('{"source":{"phantom":{}}}');
  session.run('optimise', () => undefined);
  const points = session.view('optimise', 'points') as Float32Array;
  const tets = session.view('optimise', 'tets') as Uint32Array;
  const labels = session.view('optimise', 'labels') as Uint16Array;
  const surface = {
    points,
    triangles: session.view('remesh', 'triangles') as Uint32Array,
    sides: session.view('remesh', 'sides') as Uint16Array,
  };
  return { points, tets, labels, neighbours: tetNeighbours(tets, points.length / 3), surface };
}

const mesh = await ball();
const none = new Set<number>();

/** Signed volume that closed, outward faces enclose. */
function enclosed(positions: Float32Array): number {
  let sum = 0;
  for (let i = 0; i < positions.length; i += 9) {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = positions.subarray(i, i + 9);
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return sum / 6;
}

function tetVolume(tet: number): number {
  const p = (k: number, d: number) => mesh.points[3 * mesh.tets[4 * tet + k] + d];
  const e = (k: number) => [0, 1, 2].map((d) => p(k, d) - p(0, d));
  const [u, v, w] = [e(1), e(2), e(3)];
  return (
    (u[0] * (v[1] * w[2] - v[2] * w[1]) +
      u[1] * (v[2] * w[0] - v[0] * w[2]) +
      u[2] * (v[0] * w[1] - v[1] * w[0])) /
    6
  );
}

describe('tetNeighbours', () => {
  it('is mutual, and across the very same three corners', () => {
    mesh.neighbours.forEach((other, face) => {
      if (other < 0) return;
      const tet = face >> 2;
      const corners = oppositeFace[face & 3].map((k) => mesh.tets[4 * tet + k]).sort();
      const back = [0, 1, 2, 3].find((k) => mesh.neighbours[4 * other + k] === tet) ?? -1;
      expect(oppositeFace[back].map((k) => mesh.tets[4 * other + k]).sort()).toEqual(corners);
    });
  });
});

describe('outerFaces', () => {
  it('encloses exactly the kept elements, whatever is kept', () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 2 ** 31 }), (seed) => {
        const kept = mesh.labels.map((_, t) => (Math.imul(t + 1, seed | 1) >>> 7) & 1);
        const wanted = [...kept].reduce((sum, keep, t) => sum + (keep ? tetVolume(t) : 0), 0);
        const faces = outerFaces(mesh, Uint8Array.from(kept), () => undefined);
        expect(enclosed(faces.positions)).toBeCloseTo(wanted, 0);
      }),
      { numRuns: 20 },
    );
  });

  it('gives each face the colour of its element', () => {
    const faces = outerFaces(mesh, new Uint8Array(mesh.labels.length).fill(1), (tet, label, out, at) =>
      out.set([tet & 255, label, 9], at),
    );
    faces.owners.forEach((tet, face) => {
      for (const corner of [0, 3, 6])
        expect([...faces.colours.subarray(9 * face + corner, 9 * face + corner + 3)]).toEqual([
          tet & 255,
          mesh.labels[tet],
          9,
        ]);
    });
  });
});

describe('keptTets', () => {
  it('keeps whole elements by the side of their centroid', () => {
    const low = keptTets(mesh.points, mesh.tets, mesh.labels, {
      hidden: none,
      plane: { normal: [1, 0, 0], offset: 0.1 },
    });
    const high = keptTets(mesh.points, mesh.tets, mesh.labels, {
      hidden: none,
      plane: { normal: [-1, 0, 0], offset: -0.1 },
    });
    expect(low.count + high.count).toBe(mesh.labels.length);
    low.kept.forEach((keep, t) => expect(keep + high.kept[t]).toBe(1));
  });

  it('leaves out hidden labels and values outside the range', () => {
    const values = Float32Array.from(mesh.labels, (_, t) => t);
    const { kept, count } = keptTets(mesh.points, mesh.tets, mesh.labels, {
      hidden: new Set([2]),
      ranges: { values: [values], lo: 10, hi: 200 },
    });
    kept.forEach((keep, t) => expect(keep === 1).toBe(t >= 10 && t <= 200 && mesh.labels[t] === 1));
    expect(count).toBe(kept.reduce((sum, keep) => sum + keep, 0));
  });
});

describe('surfaceFaces', () => {
  it('shows the triangles that border a shown label, seen as that label', () => {
    const seen = new Set<number>();
    const faces = surfaceFaces(mesh.surface, { hidden: new Set([1]), smooth: true }, (_, label) =>
      seen.add(label),
    );
    expect([...seen]).toEqual([2]);
    faces.owners.forEach((t) =>
      expect([mesh.surface.sides[2 * t], mesh.surface.sides[2 * t + 1]]).toContain(2),
    );
    for (let i = 0; i < (faces.normals?.length ?? 0); i += 3) {
      expect(Math.hypot(...(faces.normals as Float32Array).subarray(i, i + 3))).toBeCloseTo(1, 4);
    }
  });
});

describe('histograms', () => {
  it('keep their total when they are drawn in other bins', () => {
    fc.assert(
      fc.property(
        fc
          .array(fc.integer({ min: 0, max: 1000 }), { minLength: 1, maxLength: 40 })
          .filter((counts) => counts.some((count) => count > 0)),
        fc.double({ min: -5, max: 5, noNaN: true }),
        fc.double({ min: 0.1, max: 9, noNaN: true }),
        (counts, lo, width) => {
          const shares = rebin({ lo: 0, hi: 4, counts }, lo, lo + width, 17);
          expect(shares.reduce((sum, share) => sum + share, 0)).toBeCloseTo(100, 6);
        },
      ),
    );
  });

  it('cover nearly everything in their common range', () => {
    expect(coveringRange([{ lo: 0, hi: 10, counts: [0, 0, 5, 5, 0, 0, 0, 0, 0, 0] }])).toEqual([2, 4]);
    expect(coveringRange([{ lo: 3, hi: 3, counts: [7] }])).toEqual([2.5, 3.5]);
    expect(coveringRange([])).toEqual([0, 1]);
  });
});

describe('colours', () => {
  it('run from the first to the last stop, and differ between neighbouring labels', () => {
    const table = colourTable('viridis');
    expect([...table.subarray(0, 3)]).toEqual([0x44, 0x01, 0x54]);
    expect([...table.subarray(765)]).toEqual([0xfd, 0xe7, 0x25]);
    const many = Array.from({ length: 64 }, (_, i) => labelColour(i + 1));
    expect(new Set(many).size).toBe(64);
    for (const colour of many) expect(colour).toMatch(/^#[0-9a-f]{6}$/);
  });

  it('are scaled without the outermost values', () => {
    const [lo, hi] = robustRange(Float32Array.from({ length: 1000 }, (_, i) => (i === 0 ? -1e9 : i)));
    expect(lo).toBeGreaterThan(0);
    expect(hi).toBeLessThan(1000);
    expect(robustRange(new Float32Array([3, 3, 3]))).toEqual([2.5, 3.5]);
  });
});
