import fc from 'fast-check';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Recipe } from '../../engine/contract';
import { editRecipe, recipe, redo, redoLabel, startRecipe, undo, undoLabel } from './recipe';

const fresh = () =>
  ({ labels: [], merge: [], sizing: { edge_mm: 2, regions: [], labels: [] } }) as unknown as Recipe;

beforeEach(() => startRecipe(fresh()));

const edits = fc.oneof(
  fc
    .double({ min: 0.1, max: 50, noNaN: true })
    .map((edge) => (draft: Recipe) => void (draft.sizing.edge_mm = edge)),
  fc
    .uniqueArray(fc.integer({ min: 1, max: 9 }))
    .map((labels) => (draft: Recipe) => void (draft.labels = labels)),
  fc
    .integer({ min: 1, max: 9 })
    .map((label) => (draft: Recipe) => void draft.sizing.labels.push({ label, edge_mm: 1 })),
  fc.constant((draft: Recipe) => void draft.sizing.labels.shift()),
);

describe('the history of a recipe', () => {
  it('takes an edit whose function gives something back', () => {
    editRecipe('change', (draft) => Object.assign(draft.sizing, { edge_mm: 3 }));
    expect(recipe.value?.sizing.edge_mm).toBe(3);
  });

  it('goes back to every earlier state, and forth again', () => {
    fc.assert(
      fc.property(fc.array(edits, { maxLength: 12 }), (changes) => {
        startRecipe(fresh());
        const states = [recipe.value];
        for (const change of changes) {
          editRecipe('change', change);
          if (recipe.value !== states.at(-1)) states.push(recipe.value);
        }
        for (const state of states.slice(0, -1).reverse()) {
          undo();
          expect(recipe.value).toEqual(state);
        }
        expect(undoLabel.value).toBeNull();
        for (const state of states.slice(1)) {
          redo();
          expect(recipe.value).toEqual(state);
        }
        expect(redoLabel.value).toBeNull();
      }),
    );
  });

  it('takes along what stands beside the recipe, joined steps last to first', () => {
    const told: string[] = [];
    const beside = (name: string) => ({
      undo: () => void told.push(`undo ${name}`),
      redo: () => void told.push(`redo ${name}`),
    });
    const step = (name: string) => editRecipe('Paint', () => undefined, 'stroke', Infinity, beside(name));
    step('first');
    step('second');
    expect(undoLabel.value).toBe('Paint');
    undo();
    redo();
    expect(told).toEqual(['undo second', 'undo first', 'redo first', 'redo second']);
    undo();
    expect(undoLabel.value).toBeNull();
  });

  it('joins quick edits of one control into one step, and slow ones not', () => {
    vi.useFakeTimers();
    const set = (edge: number) => editRecipe('Edge', (draft) => void (draft.sizing.edge_mm = edge), 'edge');
    set(3);
    vi.advanceTimersByTime(200);
    set(4);
    vi.advanceTimersByTime(5000);
    set(5);
    vi.useRealTimers();
    undo();
    expect(recipe.value?.sizing.edge_mm).toBe(4);
    undo();
    expect(recipe.value?.sizing.edge_mm).toBe(2);
  });

  it('joins the steps of one drag, however slow', () => {
    vi.useFakeTimers();
    const drag = (edge: number, key: string) =>
      editRecipe('Drag', (draft) => void (draft.sizing.edge_mm = edge), key, Infinity);
    drag(6, 'drag 1');
    vi.advanceTimersByTime(60_000);
    drag(7, 'drag 1');
    drag(8, 'drag 2');
    vi.useRealTimers();
    undo();
    expect(recipe.value?.sizing.edge_mm).toBe(7);
    undo();
    expect(recipe.value?.sizing.edge_mm).toBe(2);
  });

  it('forgets what was undone once something else is edited', () => {
    editRecipe('a', (draft) => void (draft.merge = [[1, 2]]));
    undo();
    editRecipe('b', (draft) => void (draft.sizing.edge_mm = 9));
    expect(redoLabel.value).toBeNull();
  });

  it('takes no step for an edit that changes nothing', () => {
    editRecipe('nothing', (draft) => void (draft.sizing.edge_mm = 2));
    expect(undoLabel.value).toBeNull();
  });
});
