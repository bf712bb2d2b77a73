import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  dot,
  indexMap,
  obliqueness,
  orientationLetters,
  sidesOf,
  sliceFrames,
  toIndex,
  toMm,
} from './orientation';

const ras = [1, 0, 0, 5, 0, 2, 0, 6, 0, 0, 3, 7, 0, 0, 0, 1];
const lps = [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** First axis to the head, second to the left, third to the front. */
const sla = [0, -1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1];

function turned(degrees: number): number[] {
  const c = Math.cos((degrees * Math.PI) / 180);
  const s = Math.sin((degrees * Math.PI) / 180);
  return [c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
}

describe('orientation of an image', () => {
  it('has a letter for where each axis leads', () => {
    expect(orientationLetters(ras)).toBe('RAS');
    expect(orientationLetters(lps)).toBe('LPS');
    expect(orientationLetters(sla)).toBe('SLA');
    expect(orientationLetters(turned(30))).toBe('RAS');
  });

  it('tells how far the axes are from the patient', () => {
    expect(obliqueness(ras)).toBeCloseTo(0);
    expect(obliqueness(turned(30))).toBeCloseTo(30);
  });

  it('names two sides where a direction is between them', () => {
    expect(sidesOf([1, 0.1, 0])).toBe('R');
    expect(sidesOf([-0.8, 0, 0.6])).toBe('LS');
  });
});

describe('slices', () => {
  it.each([ras, lps, sla, turned(20)])('show the same sides whatever the image axes are', (...matrix) => {
    const [axial, coronal, sagittal] = sliceFrames(matrix as number[]);
    const lead = (frame: typeof axial) => [
      sidesOf(frame.right)[0],
      sidesOf(frame.up)[0],
      sidesOf(frame.towards)[0],
    ];
    expect(lead(axial)).toEqual(['L', 'A', 'I']);
    expect(lead(coronal)).toEqual(['L', 'S', 'A']);
    expect(lead(sagittal)).toEqual(['P', 'S', 'L']);
    expect(new Set([axial, coronal, sagittal].map((frame) => frame.across)).size).toBe(3);
  });

  it('go from voxels to millimetres and back', () => {
    const place = fc.double({ min: -50, max: 50, noNaN: true });
    fc.assert(
      fc.property(fc.tuple(place, place, place), (index) => {
        for (const matrix of [ras, sla, turned(33)])
          toIndex(matrix, toMm(matrix, index)).forEach((part, axis) =>
            expect(part).toBeCloseTo(index[axis], 6),
          );
      }),
    );
    expect(dot(toMm(ras, [1, 1, 1]), [1, 1, 1])).toBe(6 + 8 + 10);
  });
});

it('the map from one grid to another is that by way of millimetres', () => {
  const m = indexMap(turned(30), ras);
  const index = [3, -2, 5];
  const direct = [0, 1, 2].map(
    (row) => m[4 * row] * 3 - m[4 * row + 1] * 2 + m[4 * row + 2] * 5 + m[4 * row + 3],
  );
  toIndex(ras, toMm(turned(30), index)).forEach((x, row) => expect(direct[row]).toBeCloseTo(x, 9));
});
