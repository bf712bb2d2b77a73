import { describe, expect, it } from 'vitest';
import { innerGrid, valuesAt, type Grid } from './grid_values';

// Turned about S, spacing 2 × 3 × 4.
const grid: Grid = {
  size: [5, 6, 7],
  indexToMm: [0, -3, 0, 10, 2, 0, 0, -4, 0, 0, 4, 1, 0, 0, 0, 1],
};
const mm = (i: number, j: number, k: number) => [10 - 3 * j, -4 + 2 * i, 1 + 4 * k];
const values = Float32Array.from({ length: 5 * 6 * 7 }, (_, at) => {
  const [i, j, k] = [at % 5, Math.floor(at / 5) % 6, Math.floor(at / 30)];
  return 1 + i + 10 * j + 100 * k;
});

describe('valuesAt', () => {
  it('is linear between grid points, and that of the border beyond it', () => {
    const places = Float32Array.from([mm(1, 2, 3), mm(1.5, 2.25, 3.75), mm(-3, 2, 3), mm(4, 5, 99)].flat());
    const found = valuesAt(values, grid, places);
    [322, 400, 321, 655].forEach((value, i) => expect(found[i]).toBeCloseTo(value, 3));
  });

  it('leaves out grid points without a value, and goes on from those within two steps', () => {
    const holed = values.slice();
    holed[1 + 5 * (2 + 6 * 3)] = 0;
    const at = (field: Float32Array, ...place: [number, number, number]) =>
      valuesAt(field, grid, Float32Array.from(mm(...place)))[0];
    expect(at(holed, 1.5, 2, 3)).toBeCloseTo(323, 3);
    // All its neighbours, the near ones more.
    expect(at(holed, 1, 2, 3)).toBeCloseTo(322, 3);
    const lone = new Float32Array(values.length);
    lone[1 + 5 * (2 + 6 * 3)] = 7;
    expect(at(lone, 2.5, 2, 3)).toBe(7);
    expect(at(lone, 3.5, 2, 3)).toBeNaN();
  });
});

it('the inner grid has the same points at the same places', () => {
  const { size, indexToMm } = innerGrid(grid, 2);
  expect(size).toEqual([1, 2, 3]);
  expect([indexToMm[3], indexToMm[7], indexToMm[11]]).toEqual(mm(2, 2, 2));
});
