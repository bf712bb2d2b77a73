import { beforeEach, describe, expect, it } from 'vitest';
import type { Recipe } from '../../engine/contract';
import { simulation } from '../run/frames';
import { bodyShown } from '../view';
import { addRegion, bodiesInView, bodiesOf, editBody } from './bodies';
import { recipe, startRecipe, undo, undoLabel } from './recipe';

const ball = { shape: 'sphere', centre_mm: [0, 0, 0], radius_mm: 5 };
const fresh = () =>
  ({
    sizing: { edge_mm: 4, regions: [{ ...ball, name: 'a', edge_mm: 1, band_mm: 3 }] },
    physics: {
      stimuli: [
        { ...ball, name: 'one', start_ms: 0 },
        { ...ball, name: 'two', start_ms: 9 },
      ],
      monodomain: { electrodes: [{ name: 'lead', at_mm: [1, 2, 3] }] },
    },
  }) as unknown as Recipe;

beforeEach(() => {
  startRecipe(fresh());
  simulation.value = 'none';
  bodyShown.value = null;
});

describe('a new region', () => {
  it('has its middle where it is said, is finer than the rest, and is the one that is shown', () => {
    addRegion('sphere', [1.234, -5.67, 8]);
    expect(recipe.value?.sizing.regions[1]).toMatchObject({
      name: 'Region 2',
      shape: 'sphere',
      centre_mm: [1.2, -5.7, 8],
      edge_mm: 2,
    });
    expect(bodyShown.value).toEqual({ kind: 'region', index: 1 });
    undo();
    expect(recipe.value?.sizing.regions).toHaveLength(1);
  });
});

describe('bodies', () => {
  it('are the regions, stimuli and electrodes of a recipe; an electrode stands where it is', () => {
    expect(bodiesOf(recipe.value).map(({ kind, index, band_mm }) => [kind, index, band_mm])).toEqual([
      ['region', 0, 3],
      ['stimulus', 0, 0],
      ['stimulus', 1, 0],
      ['electrode', 0, 0],
    ]);
    expect(bodiesOf(recipe.value)[3].region.centre_mm).toEqual([1, 2, 3]);
    expect(bodiesOf(null)).toEqual([]);
  });

  it('are changed where they stand in the recipe, each drag one step', () => {
    editBody('Move stimulus', { kind: 'stimulus', index: 1 }, { centre_mm: [4, 0, 0] }, 'drag 1', Infinity);
    editBody('Move stimulus', { kind: 'stimulus', index: 1 }, { centre_mm: [5, 0, 0] }, 'drag 1', Infinity);
    expect(recipe.value?.physics?.stimuli.map(({ centre_mm }) => centre_mm[0])).toEqual([0, 5]);
    expect(undoLabel.value).toBe('Move stimulus');
    undo();
    expect(recipe.value?.physics?.stimuli[1].centre_mm).toEqual([0, 0, 0]);
    editBody('Resize region', { kind: 'region', index: 0 }, { radius_mm: 7 }, 'drag 2');
    expect(recipe.value?.sizing.regions[0]).toMatchObject({ radius_mm: 7, edge_mm: 1 });
  });

  it('that are points have a place only', () => {
    editBody(
      'Move electrode',
      { kind: 'electrode', index: 0 },
      { centre_mm: [9, 9, 9], radius_mm: 4 },
      'drag',
    );
    expect(recipe.value?.physics?.monodomain?.electrodes[0]).toEqual({ name: 'lead', at_mm: [9, 9, 9] });
  });

  it('do not lie over frames that are played, but for regions and the chosen one', () => {
    expect(bodiesInView(recipe.value)).toHaveLength(4);
    simulation.value = 'done';
    expect(bodiesInView(recipe.value).map(({ kind }) => kind)).toEqual(['region']);
    bodyShown.value = { kind: 'stimulus', index: 1 };
    expect(bodiesInView(recipe.value).map(({ kind }) => kind)).toEqual(['region', 'stimulus']);
  });
});
