import { describe, expect, it } from 'vitest';
import { speedErrorText } from './describe';

describe('the error of a wave in words', () => {
  it.each([
    [-4.2, '4 % slow here'],
    [2.6, '3 % fast here'],
    [-0.42, '0.4 % slow here'],
    [0.01, 'right here'],
  ])('%f is "%s"', (percent, text) => expect(speedErrorText(percent)).toBe(text));
});
