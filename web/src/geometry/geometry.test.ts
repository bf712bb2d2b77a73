import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import createVoxtet from '../engine/testing/mock_engine.mjs';
import { colourTable, labelColour } from './colours';
import { robustRange, surfaceFaces } from './faces';
import { freeSide } from './free_side';
import { coveringRange, rebin, shareWithin, spreadByFactor } from './histogram';
import { smoothNormals } from './smooth_normals';
import { chosenBit, nearBit, shownBit, tetFaces, tetMask } from './tet_faces';
import { oppositeFace, tetNeighbours } from './tet_neighbours';

/** The ball of the mock engine: 2,760 tetrahedra of two labels. */
async function ball() {
  const engine = await createVoxtet();
  const session = new engine.Session();
  session.setRecipe('{"source":{"phantom":{}}}');
  session.begin('optimise');
  session.advance(Infinity, () => undefined);
  const points = session.array('optimise', 'points') as Float32Array;
  const tets = session.array('optimise', 'tets') as Uint32Array;
  const labels = session.array('optimise', 'labels') as Uint16Array;
  const surface = {
    points,
    triangles: session.array('remesh', 'triangles') as Uint32Array,
    sides: session.array('remesh', 'sides') as Uint16Array,
  };
  return { points, tets, labels, neighbours: tetNeighbours(tets, points.length / 3), surface };
}

const mesh = await ball();
const none = new Set<number>();

const drawn = tetFaces(mesh);

/** Corners of the half-faces that the view's shader draws of the tets that are kept, seen from outside. */
function drawnFaces(kept: (tet: number) => boolean): number[][] {
  const corners = (half: number) => oppositeFace[half & 3].map((k) => mesh.tets[(half & ~3) + k]);
  const seen: number[][] = [];
  drawn.faces.forEach((half, face) => {
    const other = mesh.neighbours[half];
    const mine = kept(half >> 2);
    const theirs = other >= 0 && kept(other);
    if (face < drawn.extents[1] ? mine && !theirs : mine !== theirs)
      seen.push(mine ? corners(half) : corners(half).reverse());
  });
  return seen;
}

/** Signed volume that closed, outward faces enclose. */
function enclosed(faces: number[][]): number {
  const at = (corner: number) => mesh.points.subarray(3 * corner, 3 * corner + 3);
  return faces.reduce((sum, face) => {
    const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = face.map(at);
    return sum + (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6;
  }, 0);
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

describe('tetFaces', () => {
  it('has the faces that enclose exactly the kept elements, whatever is kept', () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 2 ** 31 }), (seed) => {
        const kept = (t: number) => ((Math.imul(t + 1, seed | 1) >>> 7) & 1) === 1;
        const wanted = [...mesh.labels.keys()].reduce((sum, t) => sum + (kept(t) ? tetVolume(t) : 0), 0);
        expect(enclosed(drawnFaces(kept))).toBeCloseTo(wanted, 0);
      }),
      { numRuns: 20 },
    );
  });

  it('begins with what is seen of the whole body, then what is between its labels', () => {
    const [outer, between, reach] = drawn.extents;
    const faces = [...drawn.faces];
    expect(faces.slice(0, outer).every((half) => mesh.neighbours[half] < 0)).toBe(true);
    expect(faces.slice(outer, between).every((half) => differs(half))).toBe(true);
    expect(faces.slice(between).some((half) => mesh.neighbours[half] < 0 || differs(half))).toBe(false);
    expect(2 * (faces.length - between) + between).toBe(mesh.neighbours.length);
    expect(reach).toBeGreaterThan(2);
    expect(reach).toBeLessThan(4);
  });
});

function differs(half: number): boolean {
  return mesh.labels[mesh.neighbours[half]] !== mesh.labels[half >> 2];
}

describe('tetMask', () => {
  it('leaves out hidden labels, and chooses by value', () => {
    const values = Float32Array.from(mesh.labels, (_, t) => t);
    const { mask, count } = tetMask(drawn.centres, {
      hidden: new Set([2]),
      ranges: { values: [values], lo: 10, hi: 200 },
    });
    mask.forEach((bits, t) => {
      expect(bits & shownBit).toBe(mesh.labels[t] === 1 ? shownBit : 0);
      expect(bits & chosenBit).toBe(t >= 10 && t <= 200 && mesh.labels[t] === 1 ? chosenBit : 0);
    });
    expect(count).toBe(mask.reduce((sum, bits) => sum + (bits & chosenBit ? 1 : 0), 0));
  });

  it('chooses one element, even of a hidden label, and knows those near it by their centroid', () => {
    const tet = mesh.labels.indexOf(1);
    const [x0, y0, z0] = drawn.centres.subarray(4 * tet, 4 * tet + 3);
    for (const hidden of [none, new Set([1])]) {
      const { mask, count } = tetMask(drawn.centres, { hidden, single: { tet, radius: 6 } });
      expect(count).toBe(1);
      mask.forEach((bits, t) => {
        const [x, y, z] = drawn.centres.subarray(4 * t, 4 * t + 3);
        const near = Math.hypot(x - x0, y - y0, z - z0) <= 6 && !hidden.has(mesh.labels[t]);
        expect([bits & chosenBit, bits & nearBit]).toEqual([t === tet ? chosenBit : 0, near ? nearBit : 0]);
      });
    }
  });
});

describe('freeSide', () => {
  it('looks at an element of the surface from outside', () => {
    // Of the outermost elements each is free away from the middle of the ball.
    const outer = drawn.faces.subarray(0, drawn.extents[0]).filter((_, i) => i % 40 === 0);
    for (const half of outer) {
      const tet = half >> 2;
      const way = freeSide({ ...mesh, ...drawn }, tet, none);
      const centre = drawn.centres.subarray(4 * tet, 4 * tet + 3);
      const out = way.reduce((sum, part, i) => sum + part * centre[i], 0) / Math.hypot(...centre);
      expect(out).toBeGreaterThan(0);
    }
  });

  it('looks at the broad side of a flat element that stands alone', () => {
    const points = Float32Array.from([0, 0, 0, 4, 0, 0, 4, 4, 0.1, 0, 4, 0.2]);
    const tets = Uint32Array.from([0, 1, 2, 3]);
    const alone = { points, tets, centres: Float32Array.from([2, 2, 0.1, 1]) };
    expect(Math.abs(freeSide(alone, 0, none)[2])).toBeGreaterThan(0.9);
  });
});

describe('surfaceFaces', () => {
  it('shows the triangles that border a shown label, seen as that label', () => {
    const seen = new Set<number>();
    const faces = surfaceFaces(mesh.surface, new Set([1]), (_, label) => seen.add(label));
    expect([...seen]).toEqual([2]);
    faces.owners.forEach((t) =>
      expect([mesh.surface.sides[2 * t], mesh.surface.sides[2 * t + 1]]).toContain(2),
    );
  });
});

describe('smoothNormals', () => {
  it('point the way of their triangles, the same for all that meet at a point of one boundary', () => {
    const { points, triangles, sides } = mesh.surface;
    const normals = smoothNormals(mesh.surface);
    const known = new Map<string, number[]>();
    for (let corner = 0; corner < triangles.length; corner++) {
      const normal = [...normals.subarray(3 * corner, 3 * corner + 3)];
      expect(Math.hypot(...normal)).toBeCloseTo(1, 4);
      const t = Math.floor(corner / 3);
      const place = `${triangles[corner]} ${sides[2 * t]} ${sides[2 * t + 1]}`;
      expect(normal).toEqual(known.get(place) ?? normal);
      known.set(place, normal);
      const outward = normal.reduce((sum, part, d) => sum + part * points[3 * triangles[corner] + d], 0);
      expect(outward).toBeGreaterThan(0);
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

describe('a histogram that is spread by a factor', () => {
  it('keeps its total, and ends at the factor', () => {
    fc.assert(
      fc.property(
        fc.array(fc.nat(1000), { minLength: 1, maxLength: 40 }).filter((counts) => counts.some((n) => n > 0)),
        fc.double({ min: 0, max: 3, noNaN: true }),
        (counts, lo) => {
          const source = { lo, hi: lo + 2, counts };
          const wide = spreadByFactor(source, Math.SQRT2);
          const total = (of: number[]) => of.reduce((sum, n) => sum + n, 0);
          expect(total(wide.counts)).toBeCloseTo(total(counts), 6);
          expect([wide.lo, wide.hi]).toEqual([lo / Math.SQRT2, (lo + 2) * Math.SQRT2]);
        },
      ),
    );
  });

  it('is flat by its logarithm where there was one value', () => {
    const counts = new Array<number>(50).fill(0);
    counts[40] = 100; // at 4.05
    const wide = spreadByFactor({ lo: 0, hi: 5, counts }, 2);
    expect(shareWithin(wide, 0, 4.05)).toBeCloseTo(0.5, 2);
    expect(shareWithin(wide, 4.05 / Math.SQRT2, 4.05)).toBeCloseTo(0.25, 2);
  });

  it('says which part is within a range', () => {
    const source = { lo: 0, hi: 4, counts: [1, 1, 1, 1] };
    expect(shareWithin(source, 1, 3)).toBeCloseTo(0.5, 12);
    expect(shareWithin(source, 0.5, 9)).toBeCloseTo(0.875, 12);
    expect(shareWithin({ lo: 2, hi: 2, counts: [5] }, 1, 3)).toBe(1);
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
