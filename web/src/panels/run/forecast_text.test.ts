import { expect, it } from 'vitest';
import { amount, changeText, forecastParts, refusal, span } from './forecast_text';

const numbers = {
  tets: 48_251,
  points: 1,
  triangles: 1,
  peak_mb: 67.1,
  seconds: 1.97,
  seconds_here: [1.4, 3.2] as [number, number],
};

it('says what a run will take, no more exactly than is known', () => {
  expect(forecastParts(numbers, [])).toEqual(['about 48,000 tetrahedra', '67 MB', '1 to 3 s']);
  expect(amount('seconds', 0.2)).toBe('1 s');
  expect(amount('seconds', 89.6)).toBe('90 s');
  expect(amount('seconds', 150)).toBe('3 min');
});

it('gives times as a range, in minutes where they are long', () => {
  expect(span([0.2, 0.9])).toBe('1 s');
  expect(span([3.4, 7.6])).toBe('3 to 8 s');
  expect(span([60, 137])).toBe('1 to 2 min');
  expect(span([200, 460])).toBe('3 to 8 min');
  const beyond = { field: 'seconds' as const, found: 1.97, limit: 1 };
  expect(forecastParts(numbers, [beyond])[2]).toBe('2 s (limit 1 s)');
});

it('says what the last step has changed of the number of tetrahedra', () => {
  expect(changeText(numbers, null)).toBe('');
  expect(changeText(numbers, { ...numbers, tets: 40_000 })).toBe(' (was 40,000)');
  expect(changeText(numbers, { ...numbers, tets: 48_300 })).toBe(' (as before)');
});

it('names the limit that would refuse a case, as it was set', () => {
  const beyond = { field: 'tets' as const, found: 48_251, limit: 12_345 };
  expect(forecastParts(numbers, [beyond])[0]).toBe('about 48,000 tetrahedra (limit 12,345)');
  expect(refusal(beyond)).toBe('limits.tets: the forecast is about 48,000 tetrahedra, the limit 12,345.');
  expect(refusal({ field: 'memory_mb', found: 67.1, limit: 50 })).toContain('about 67 MB, the limit 50 MB');
});
