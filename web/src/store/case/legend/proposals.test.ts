import { describe, expect, it } from 'vitest';
import type { Surroundings } from '../../../engine/contract';
import { leaveOut, likelyBackground, likelyWall } from './proposals';

const label = (number: number, voxels: number) => ({ label: number, voxels, name: '', colour: null });
const around = (number: number, contacts: Record<number, number>, border_share = 0): Surroundings => ({
  label: number,
  contacts: Object.entries(contacts)
    .map(([other, share]) => ({ label: Number(other), share }))
    .sort((a, b) => b.share - a.share),
  border_share,
});

/** Two ventricles: walls 1 and 2, blood 3 and 4, a scar 5 in the left wall. */
const heart = {
  labels: [label(1, 1000), label(2, 400), label(3, 900), label(4, 950), label(5, 80)],
  surroundings: [
    around(1, { 0: 0.45, 3: 0.3, 4: 0.1, 5: 0.1 }),
    around(2, { 0: 0.5, 4: 0.45, 1: 0.05 }),
    around(3, { 1: 0.8, 0: 0.2 }),
    around(4, { 2: 0.55, 1: 0.3, 0: 0.15 }),
    around(5, { 1: 0.7, 0: 0.2, 3: 0.1 }),
  ],
};

describe('walls', () => {
  it('encloses the largest pool that is not meshed, and takes in what lies in it', () => {
    expect(likelyWall(heart, [1, 2, 5])).toEqual({ wall: [2], inner: [4] });
    expect(
      likelyWall(
        { ...heart, labels: heart.labels.map((one) => (one.label === 3 ? label(3, 999) : one)) },
        [1, 2, 5],
      ),
    ).toEqual({ wall: [1, 5], inner: [3] });
  });

  it('proposes another inside for another wall', () => {
    expect(likelyWall(heart, [1, 2, 5], [4])).toEqual({ wall: [1, 5], inner: [3] });
  });

  it('never takes the background for what is inside', () => {
    const boxed = {
      labels: [label(1, 90), label(4, 20), label(2, 10)],
      surroundings: [around(1, { 4: 1 }, 0.9), around(4, { 1: 0.7, 2: 0.3 }), around(2, { 4: 1 })],
    };
    expect(likelyWall(boxed, [2, 4])).toEqual({ wall: [4], inner: [2] });
  });

  it('goes by size where all labels are meshed', () => {
    expect(likelyWall(heart, [])).toEqual({ wall: [2], inner: [4] });
  });

  it('is the largest label where none encloses another', () => {
    const shells = {
      labels: [label(1, 10), label(2, 30)],
      surroundings: [around(1, { 0: 1 }), around(2, { 0: 1 })],
    };
    expect(likelyWall(shells, [])).toEqual({ wall: [2], inner: [] });
    expect(likelyWall({ labels: [label(7, 5)] }, [])).toEqual({ wall: [7], inner: [] });
  });
});

it('takes for the background what has most of the border of the image', () => {
  const boxed = {
    labels: [label(1, 10), label(2, 3)],
    surroundings: [around(1, { 2: 1 }, 0.9), around(2, { 1: 1 })],
  };
  expect(likelyBackground(boxed, [1, 2])).toBe(1);
  expect(likelyBackground(boxed, [2])).toBeNull();
  expect(likelyBackground(heart, [1, 2, 3, 4, 5])).toBeNull();
  const draft = { labels: [] as number[] };
  leaveOut(1, [1, 2], draft as never);
  expect(draft.labels).toEqual([2]);
});
