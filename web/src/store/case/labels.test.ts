import { describe, expect, it } from 'vitest';
import type { Recipe } from '../../engine/contract';
import { dropIdleSizes, groupedWith, groupsOf, mergesAll } from './labels';

describe('merged labels', () => {
  it('are all merged only when one group holds every chosen label', () => {
    expect(mergesAll([[1, 2]], [1, 2])).toBe(true);
    expect(mergesAll([[1, 2]], [1, 2, 5])).toBe(false);
    expect(mergesAll([[1], [2]], [1, 2])).toBe(false);
    expect(mergesAll([], [1])).toBe(false);
  });

  it('stay one group when the choice changes', () => {
    expect(groupsOf([[1, 2]], [1, 2], [1, 2, 5])).toEqual([[1, 2, 5]]);
    expect(groupsOf([[1, 2, 5]], [1, 2, 5], [1])).toEqual([[1]]);
  });

  it('are joined and parted one by one', () => {
    expect(groupedWith([], 5, 1)).toEqual([[1, 5]]);
    expect(groupedWith([[1, 5]], 6, 1)).toEqual([[1, 5, 6]]);
    expect(groupedWith([[1, 5, 6]], 5, 5)).toEqual([[1, 6]]);
    expect(groupedWith([[1, 5]], 5, 2)).toEqual([[2, 5]]);
    expect(groupedWith([[1, 5]], 1, 1)).toEqual([]);
  });

  it('leave a size only to labels that carry a region', () => {
    const size = (label: number) => ({ label, edge_mm: 1, slope: 1 });
    const draft = {
      merge: [[1, 5]],
      sizing: {
        labels: [size(1), size(5), size(3)],
        distances: [size(5), size(2)],
        curvature: [{ labels: [] }, { labels: [2, 5] }, { labels: [3] }],
      },
    } as unknown as Recipe;
    dropIdleSizes(draft, [1, 2, 5]);
    expect(draft.sizing).toEqual({
      labels: [size(1)],
      distances: [size(2)],
      curvature: [{ labels: [] }, { labels: [2] }],
    });
  });

  it('lose what is no longer chosen and groups that become empty', () => {
    expect(groupsOf([[1, 5], [2]], [1, 2, 5], [1, 5])).toEqual([[1, 5]]);
    expect(groupsOf([], [1, 2], [1])).toEqual([]);
  });
});
