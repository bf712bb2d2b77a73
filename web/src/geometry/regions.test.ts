import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { SizeRegion, Vec3 } from '../engine/contract';
import { movedRegion, pulledRegion, regionDistance, zeroLines } from './regions';

const base: SizeRegion = {
  name: '',
  shape: 'sphere',
  centre_mm: [1, 2, 3],
  end_mm: [1, 2, 13],
  half_size_mm: [2, 4, 6],
  axes_deg: [0, 0, 90],
  radius_mm: 5,
  edge_mm: 1,
  band_mm: 2,
};
const shapes = (['sphere', 'box', 'capsule'] as const).map((shape) => ({ ...base, shape }));
const [sphere, box, capsule] = shapes;
const places = fc.tuple(
  ...[0, 1, 2].map(() => fc.double({ min: -20, max: 20, noNaN: true })),
) as unknown as fc.Arbitrary<Vec3>;

describe('a region', () => {
  it('is as far away as its shape says', () => {
    expect(regionDistance(sphere, [1, 2, 13])).toBeCloseTo(5);
    expect(regionDistance(capsule, [1, 2, 20])).toBeCloseTo(2);
    expect(regionDistance(capsule, [4, 2, 8])).toBeCloseTo(-2);
    // Turned by a right angle, its first half size is along y.
    expect(regionDistance(box, [1, 5, 3])).toBeCloseTo(1);
    expect(regionDistance(box, [4, 2, 3])).toBeCloseTo(-1);
  });

  it.each(shapes)('keeps its distances when it is moved: $shape', (region) => {
    fc.assert(
      fc.property(places, places, (point, by) => {
        const moved = { ...region, ...movedRegion(region, by.map(Math.round)) };
        const along = point.map((x, i) => x + Math.round(by[i]));
        expect(regionDistance(moved, along)).toBeCloseTo(regionDistance(region, point), 6);
      }),
    );
  });

  it('goes where its surface is pulled to', () => {
    expect(pulledRegion(sphere, [6, 2, 3], [8, 2, 3])).toEqual({ radius_mm: 7 });
    expect(pulledRegion(box, [1, 4, 3], [1, 7, 3])).toEqual({ half_size_mm: [5, 4, 6] });
    expect(pulledRegion(sphere, [6, 2, 3], [1, 2, 3])).toEqual({ radius_mm: 0.1 });
  });
});

describe('zeroLines', () => {
  it('go round a circle, every end on it', () => {
    const lines = zeroLines((x, y) => Math.hypot(x - 50, y - 40) - 25, 100, 80, 4);
    let length = 0;
    for (let i = 0; i < lines.length; i += 4) {
      expect(Math.hypot(lines[i] - 50, lines[i + 1] - 40)).toBeCloseTo(25, 0);
      length += Math.hypot(lines[i + 2] - lines[i], lines[i + 3] - lines[i + 1]);
    }
    expect(length).toBeGreaterThan(0.98 * 2 * Math.PI * 25);
    expect(length).toBeLessThan(2 * Math.PI * 25 + 0.5);
  });
});
