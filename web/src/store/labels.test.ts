import { describe, expect, it } from 'vitest';
import { groupsOf, mergesAll } from './labels';

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

  it('lose what is no longer chosen and groups that become empty', () => {
    expect(groupsOf([[1, 5], [2]], [1, 2, 5], [1, 5])).toEqual([[1, 5]]);
    expect(groupsOf([], [1, 2], [1])).toEqual([]);
  });
});
