import { expect, it } from 'vitest';
import { inRows, texelsPerRow, withRoom } from './rows';

it('an array with room becomes whole rows without a copy, another with one', () => {
  const numbers = Uint32Array.from({ length: 4 * texelsPerRow + 8 }, (_, i) => i);
  const roomy = withRoom(numbers);
  expect(roomy).toEqual(numbers);
  for (const channels of [1, 4] as const) {
    const rows = inRows(roomy, channels);
    expect(rows.buffer).toBe(roomy.buffer);
    for (const found of [rows, inRows(numbers, channels)]) {
      expect(found.length % (channels * texelsPerRow)).toBe(0);
      expect(found.subarray(0, numbers.length)).toEqual(numbers);
      expect(found.subarray(numbers.length).every((x) => x === 0)).toBe(true);
    }
  }
});
