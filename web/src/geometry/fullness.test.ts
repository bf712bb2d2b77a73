import { describe, expect, it } from 'vitest';
import { fullness } from './fullness';

describe('fullness', () => {
  it('of a small image is its voxels, of the labels that count', () => {
    const labels = Uint16Array.from([0, 1, 2, 1, 0, 2, 0, 1]);
    const image = { size: [2, 2, 2], spacing_mm: [1, 1, 1] } as Parameters<typeof fullness>[1];
    const found = fullness(labels, image, (label) => label === 1);
    expect(found).toMatchObject({ size: [2, 2, 2], voxels: [1, 1, 1] });
    expect([...found.data]).toEqual([0, 255, 0, 255, 0, 0, 0, 255]);
  });

  it('of a large image is a share in cells about as long as wide', () => {
    const size = [96, 96, 25] as [number, number, number];
    // Full in the first half of its first axis, thick slices along the last.
    const labels = Uint16Array.from({ length: 96 * 96 * 25 }, (_, i) => (i % 96 < 47 ? 7 : 0));
    const found = fullness(labels, { size, spacing_mm: [1, 1, 4] }, () => true);
    expect(found.voxels).toEqual([2, 2, 1]);
    expect(found.size).toEqual([48, 48, 25]);
    expect([...found.data.subarray(22, 25)]).toEqual([255, 128, 0]);
  });
});
