import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Grid } from './grid_values';
import { readOwnNrrd, volumeDigest, writeNrrd } from './nrrd';
import { applyRuns, countLabels, dabsBetween, paintDab, runsOf, type Stroke } from './painting';

const grid: Grid = { size: [9, 8, 7], indexToMm: [-2, 0, 0, 8, 0, 2, 0, -7, 0, 0, 4, -12, 0, 0, 0, 1] };
const blank = () => new Uint8Array(9 * 8 * 7);
const dabs = fc.record({
  mm: fc.tuple(...[0, 1, 2].map(() => fc.double({ min: -16, max: 16, noNaN: true }))),
  radiusMm: fc.double({ min: 0.5, max: 9, noNaN: true }),
  across: fc.constantFrom(null, 0, 1, 2),
  label: fc.integer({ min: 0, max: 3 }),
});

describe('a stroke', () => {
  it('goes back to what was there, and forth again', () => {
    fc.assert(
      fc.property(fc.array(dabs, { maxLength: 8 }), (all) => {
        const labels = blank();
        const states = [labels.slice()];
        const steps = all.map(({ label, ...dab }) => {
          const stroke: Stroke = { label, voxels: [], before: [] };
          paintDab(labels, grid, dab, stroke);
          states.push(labels.slice());
          return runsOf(stroke);
        });
        for (let i = steps.length - 1; i >= 0; i--) {
          applyRuns(labels, steps[i], 'before');
          expect(labels).toEqual(states[i]);
        }
        steps.forEach((runs, i) => {
          applyRuns(labels, runs, 'after');
          expect(labels).toEqual(states[i + 1]);
        });
      }),
    );
  });

  it('labels the voxels within its radius, of one slice where it is flat', () => {
    const ball = blank();
    paintDab(ball, grid, { mm: [0, -1, 0], radiusMm: 4, across: null }, { label: 2, voxels: [], before: [] });
    const stroke: Stroke = { label: 2, voxels: [], before: [] };
    paintDab(blank(), grid, { mm: [0, -1, 0], radiusMm: 4, across: 2 }, stroke);
    // In the plane 13 voxels of 2 mm lie within 4 mm of the middle one, and one each 4 mm above and below.
    expect(countLabels(ball)).toEqual(new Map([[2, 15]]));
    expect(stroke.voxels.length).toBe(13);
    expect(runsOf(stroke).starts.length).toBe(5);
  });

  it('leaves no gaps between far places', () => {
    const way = dabsBetween([0, 0, 0], [30, 40, 0], 5);
    expect(way.at(-1)).toEqual([30, 40, 0]);
    expect(way.length).toBe(20);
  });
});

it('a painted volume is read back as it was written, and no other file is taken for one', () => {
  const labels = blank().map((_, i) => i % 5);
  const bytes = writeNrrd(grid, labels);
  expect(readOwnNrrd(bytes)).toEqual({ grid, voxels: labels });
  expect(readOwnNrrd(bytes.subarray(0, bytes.length - 1))).toBeNull();
  expect(readOwnNrrd(new TextEncoder().encode('NRRD0004\ntype: short\n\n'))).toBeNull();
});

it('the digest is over size, affine map and labels', async () => {
  const digest = await volumeDigest(grid, blank());
  expect(digest).toMatch(/^[0-9a-f]{64}$/);
  expect(await volumeDigest({ ...grid, size: [8, 9, 7] }, blank())).not.toBe(digest);
  const minus = grid.indexToMm.map((x) => (x === 0 ? -0 : x));
  expect(await volumeDigest({ ...grid, indexToMm: minus }, blank())).toBe(digest);
});
