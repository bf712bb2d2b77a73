import { describe, expect, it } from 'vitest';
import type { Recipe, VolumeSummary } from '../engine/contract';
import { estimateTets } from './estimate';

const volume = {
  spacing_mm: [1, 1, 1],
  labels: [
    { label: 1, voxels: 80_000 },
    { label: 2, voxels: 10_000 },
  ],
} as unknown as VolumeSummary;
const recipe = (change: object = {}, sizing: object = {}) =>
  ({
    labels: [],
    sizing: { edge_mm: 2, labels: [], regions: [], ...sizing },
    ...change,
  }) as unknown as Recipe;

describe('estimateTets', () => {
  it('grows eightfold when the edge length halves', () => {
    const coarse = estimateTets(recipe(), volume);
    expect(estimateTets(recipe({}, { edge_mm: 1 }), volume) / coarse).toBeCloseTo(8, 2);
  });

  it('counts chosen labels only, each with its own edge length', () => {
    const both = estimateTets(recipe(), volume);
    const one = estimateTets(recipe({ labels: [2] }), volume);
    expect(one).toBeLessThan(both / 8);
    expect(
      estimateTets(recipe({ labels: [2] }, { labels: [{ label: 2, edge_mm: 1 }] }), volume),
    ).toBeGreaterThan(7 * one);
  });
});
