import { expect, it } from 'vitest';
import { otsu, valuesOf } from './image_threshold';

it('parts dark from bright values', () => {
  const labels = [
    { label: 100, name: '', colour: null, voxels: 300 },
    { label: 110, name: '', colour: null, voxels: 200 },
    { label: 900, name: '', colour: null, voxels: 80 },
    { label: 1000, name: '', colour: null, voxels: 20 },
  ];
  const values = valuesOf({ size: [10, 10, 10], labels });
  expect([values.smallest, values.largest]).toEqual([0, 1000]);
  expect(values.histogram.counts.reduce((sum, count) => sum + count, 0)).toBe(1000);
  const threshold = otsu(values.histogram);
  expect(threshold).toBeGreaterThan(110);
  expect(threshold).toBeLessThanOrEqual(900);
});

it('has no background where every voxel has a value', () => {
  const labels = [
    { label: 5, name: '', colour: null, voxels: 4 },
    { label: 7, name: '', colour: null, voxels: 4 },
  ];
  expect(valuesOf({ size: [2, 2, 2], labels }).smallest).toBe(5);
});
