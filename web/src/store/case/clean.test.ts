import { expect, test } from 'vitest';
import type { Recipe, VolumeSummary } from '../../engine/contract';
import { clean, otherWarnings } from './clean';

test('cleaning fills in the limits that a recipe leaves at 0, and keeps the others', () => {
  const volume = { speck_voxels: 5, hole_voxels: 0, handle_voxels: 0 } as Recipe['volume'];
  clean(volume, { speck_voxels: 7, hole_voxels: 8, handle_voxels: 9 });
  expect(volume).toEqual({ speck_voxels: 5, hole_voxels: 8, handle_voxels: 9 });
});

test('a flaw is shown once: with its remedy, not among the warnings', () => {
  const text = '12 loose pieces of label 1: 12 voxels, the largest of 1';
  const known = {
    warnings: [`volume: ${text}; noise? --clean takes it away`, 'another'],
    flaws: [{ kind: 'pieces', count: 12, voxels: 12, largest: 1, labels: [[1, 12]], text }],
  } as unknown as VolumeSummary;
  expect(otherWarnings(known)).toEqual(['another']);
  expect(otherWarnings({ ...known, flaws: undefined })).toEqual(known.warnings);
});
