import { describe, expect, it } from 'vitest';
import { fullness, openness } from './fullness';

describe('fullness', () => {
  it('of a small image is its voxels, of the labels that count', () => {
    const labels = Uint16Array.from([0, 1, 2, 1, 0, 2, 0, 1]);
    const image = { size: [2, 2, 2], spacing_mm: [1, 1, 1] } as Parameters<typeof fullness>[1];
    const found = fullness(labels, image, (label) => label === 1);
    expect(found).toMatchObject({ size: [2, 2, 2], voxels: [1, 1, 1] });
    expect([...found.data]).toEqual([0, 255, 0, 255, 0, 0, 0, 255]);
  });

  it('of a large image is a share in cells about as long as wide', () => {
    const size = [80, 80, 20] as [number, number, number];
    // Full in the first half of its first axis, thick slices along the last.
    const labels = Uint16Array.from({ length: 80 * 80 * 20 }, (_, i) => (i % 80 < 39 ? 7 : 0));
    const found = fullness(labels, { size, spacing_mm: [1, 1, 4] }, () => true);
    expect(found.voxels).toEqual([2, 2, 1]);
    expect(found.size).toEqual([40, 40, 20]);
    expect([...found.data.subarray(18, 21)]).toEqual([255, 128, 0]);
  });
});

describe('openness', () => {
  const n = 15;
  const size = [n, n, n] as [number, number, number];
  const middle = 7;
  const at = (x: number, y: number, z: number) => x + n * (y + n * z);
  const grid = (isFull: (radius: number, z: number) => boolean) => ({
    size,
    voxels: [1, 1, 1] as [number, number, number],
    data: Uint8Array.from({ length: n ** 3 }, (_, i) => {
      const [x, y, z] = [i % n, Math.floor(i / n) % n, Math.floor(i / n ** 2)];
      return isFull(Math.hypot(x - middle, y - middle, z - middle), z) ? 255 : 0;
    }),
  });

  it('is full in empty space, half over a plane, and none in a closed shell', () => {
    expect(new Set(openness(grid(() => false)))).toEqual(new Set([255]));
    // Over a plane 17 of 26 directions go on and up.
    expect(openness(grid((_, z) => z < 5))[at(middle, middle, 5)]).toBe(Math.round((255 * 17) / 26));
    const shell = openness(grid((radius) => radius > 3.5 && radius < 6));
    expect(shell[at(middle, middle, middle)]).toBe(0);
    expect(shell[at(0, 0, 0)]).toBeGreaterThan(200);
  });

  it('is let in by a cut', () => {
    const shell = grid((radius) => radius > 3.5 && radius < 6);
    const cut = openness(shell, ([, , z]) => z > middle);
    const inside = cut[at(middle, middle, middle)];
    expect(inside).toBe(Math.round((255 * 9) / 26));
  });
});
