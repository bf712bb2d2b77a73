import fc from 'fast-check';
import { deflateRawSync } from 'node:zlib';
import { describe, expect, it } from 'vitest';
import { canonicalJson } from './canonical';
import {
  decodeFragment,
  encodeFragment,
  encodePlainFragment,
  jsonWithin,
  LinkError,
  maxRegions,
} from './codec';

const recipes = fc.dictionary(fc.string(), fc.jsonValue({ maxDepth: 4 }), { maxKeys: 8 }).filter((value) => {
  const regions = (value as { sizing?: { regions?: unknown[] } }).sizing?.regions;
  return !Array.isArray(regions) || regions.length <= maxRegions;
});

const squeezed = (text: string) => `#c1=${deflateRawSync(Buffer.from(text)).toString('base64url')}`;

describe('links', () => {
  it('give back what was put in, compressed or plain', async () => {
    await fc.assert(
      fc.asyncProperty(recipes, async (recipe) => {
        const wanted = JSON.parse(canonicalJson(recipe));
        expect(await decodeFragment(await encodeFragment(recipe))).toEqual(wanted);
        expect(await decodeFragment(encodePlainFragment(recipe))).toEqual(wanted);
      }),
      { numRuns: 100 },
    );
  });

  it('are the same for the same recipe, whatever the order of its fields', async () => {
    const one = await encodeFragment({ sizing: { gradation: 0.2, edge_mm: 3 }, labels: [1] });
    expect(await encodeFragment({ labels: [1], sizing: { edge_mm: 3, gradation: 0.2 } })).toBe(one);
  });

  it('are read when zlib of another program made them', async () => {
    expect(await decodeFragment(squeezed('{"labels":[1,2]}'))).toEqual({ labels: [1, 2] });
  });

  it('fail with a LinkError, never otherwise, for any text', async () => {
    await fc.assert(
      fc.asyncProperty(fc.constantFrom('#c1=', '#j=', '#', ''), fc.string(), async (start, rest) => {
        await decodeFragment(start + rest).catch((error: unknown) => expect(error).toBeInstanceOf(LinkError));
      }),
      { numRuns: 300 },
    );
  });

  it('are refused when they are cut short at any place', async () => {
    const whole = await encodeFragment({
      labels: [1, 2, 3],
      sizing: { edge_mm: 1.25, regions: [{ name: 'isthmus' }] },
    });
    for (let length = 4; length < whole.length; length++) {
      await expect(decodeFragment(whole.slice(0, length))).rejects.toBeInstanceOf(LinkError);
    }
  });

  it.each([
    ['inflate beyond 1 MB', squeezed(`{"name":"${' '.repeat(2 << 20)}"}`), '1 MB'],
    ['nest too deep', squeezed(`{"a":${'['.repeat(40)}${']'.repeat(40)}}`), 'deeper'],
    [
      'hold too many regions',
      squeezed(JSON.stringify({ sizing: { regions: Array(maxRegions + 1).fill({}) } })),
      'regions',
    ],
    ['hold a list instead of a case', squeezed('[1]'), 'object'],
    ['hold broken percent codes', '#j=%E0%A4%A', 'percent'],
  ])('are refused when they %s', async (_, fragment, reason) => {
    await expect(decodeFragment(fragment)).rejects.toThrow(reason);
  });

  it('of an object are bounded before they are written out', () => {
    expect(jsonWithin({ sizing: { edge_mm: 2 } })).toBe('{"sizing":{"edge_mm":2}}');
    let twofold: unknown = 1;
    for (let i = 0; i < 60; i++) twofold = [twofold, twofold];
    expect(() => jsonWithin({ a: twofold })).toThrow('nests deeper than 12 levels');
    const wide = Array.from({ length: 2000 }, () => 'x'.repeat(1000));
    expect(() => jsonWithin({ a: wide })).toThrow('more than 1 MB');
    const row = Array(1000).fill(1);
    expect(() => jsonWithin({ a: Array(1000).fill(Array(1000).fill(row)) })).toThrow('more than 1 MB');
  });
});
