import { describe, expect, it } from 'vitest';
import { endWeights, movedEnds } from './moved_pieces';

const mesh = {
  points: new Float32Array([0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 9, 9, 9]),
  tets: new Uint32Array([0, 1, 2, 3]),
};
const pieces = { ends: new Float32Array([0.5, 0.5, 0.5, 1, 0, 0.5]), tets: new Uint32Array([0]) };

/** Each point moved as a linear map moves it. */
const moves = (map: (p: number[]) => number[]): Float32Array => {
  const all: number[] = [];
  for (let i = 0; i < mesh.points.length; i += 3) {
    const p = [...mesh.points.subarray(i, i + 3)];
    all.push(...map(p).map((x, d) => x - p[d]));
  }
  return Float32Array.from(all);
};

describe('pieces within a tetrahedron', () => {
  it('are made of its corners, in all one', () => {
    const weights = endWeights(mesh, pieces);
    expect([...weights]).toEqual([0.25, 0.25, 0.25, 0.25, 0.25, 0.5, 0, 0.25]);
  });

  it('are stretched and turned with it', () => {
    const map = ([x, y, z]: number[]) => [3 - y, 2 * x, z + 1];
    const ends = movedEnds(mesh.tets, pieces, endWeights(mesh, pieces), moves(map));
    expect([...ends]).toEqual([...map([0.5, 0.5, 0.5]), ...map([1, 0, 0.5])]);
  });
});
