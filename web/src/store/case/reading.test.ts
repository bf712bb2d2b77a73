import { describe, expect, it } from 'vitest';
import { overlapping } from './reading';

const labels = [
  { label: 2, name: 'outer' },
  { label: 5, name: '' },
];

describe('the segments that overlap', () => {
  it('are those that lost all their voxels, then those of the volume', () => {
    const warnings = [
      'SEGMENT LOST: segment inner (of two) (label 1) loses all of its 280 voxels to outer (label 2), and will not',
      'SEGMENT LOST: segment label 7 loses all of its 3 voxels to outer (label 2), and will not',
      'segments inner (label 1) and outer (label 2) overlap in 280 voxels: of the two the later one wins',
    ];
    expect(overlapping(labels, warnings)).toEqual(['inner (of two)', '7', 'outer', '5']);
  });

  it('are none where nothing is said of them', () => {
    expect(overlapping(labels, ['another warning'])).toEqual([]);
  });
});
