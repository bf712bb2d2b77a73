import { describe, expect, it } from 'vitest';
import { fitRecipe } from './fit_recipe';

const defaults = {
  source: {},
  labels: [],
  merge: [],
  remesh: { method: 'delaunay', verify: false },
  quality: { histogram_bins: 64 },
};

describe('a saved recipe', () => {
  it('that the engine knows in full stays as it is', () => {
    const saved = { ...defaults, labels: [1, 2], source: { phantom: { kind: 'sphere' } } };
    expect(fitRecipe(saved, defaults)).toEqual({ fitted: saved, left: [] });
  });

  it('loses the fields that are unknown or of another kind, which are named', () => {
    const saved = {
      source: { file: { name: 'heart.nii', sha256: '' } },
      merge: true,
      remesh: { method: 'adapt', smoothing_voxels: 0.7 },
      polish: { rounds: 2 },
    };
    expect(fitRecipe(saved, defaults)).toEqual({
      fitted: { source: saved.source, remesh: { method: 'adapt' } },
      left: ['merge', 'remesh.smoothing_voxels', 'polish'],
    });
  });
});
