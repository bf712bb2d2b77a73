import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { boxesOf, clipped, endsAround, roundStep, ticksOf, withCounts, type Legend } from './scale';

const plain: Legend = { title: 'Angle', unit: '°', map: 'viridis', lo: 35, hi: 64 };

describe('scales', () => {
  it('have ends in round numbers around what they show', () => {
    expect(endsAround([35.3, 64.4])).toEqual({ lo: 34, hi: 66 });
    expect(endsAround([0.12, 0.98])).toEqual({ lo: 0.1, hi: 1 });
    expect(endsAround([3, 3])).toEqual({ lo: 2.5, hi: 3.5 });
    const number = fc.double({ min: -1e6, max: 1e6, noNaN: true });
    fc.assert(
      fc.property(number, fc.double({ min: 1e-3, max: 1e6, noNaN: true }), (least, length) => {
        const { lo, hi } = endsAround([least, least + length]);
        const slight = 1e-5 * (length + Math.abs(least));
        expect(lo).toBeLessThanOrEqual(least + slight);
        expect(hi).toBeGreaterThanOrEqual(least + length - slight);
        expect(hi - lo).toBeLessThanOrEqual(1.3 * length + slight);
      }),
    );
  });

  it('have ticks at 1, 2 or 5 times a power of ten, between their ends', () => {
    expect(ticksOf(plain).map(({ text }) => text)).toEqual(['35', '40', '45', '50', '55', '60']);
    expect(ticksOf({ ...plain, lo: -0.3, hi: 0.3 }).map(({ text }) => text)).toEqual([
      ...['−0.3', '−0.2', '−0.1', '0.0', '0.1', '0.2', '0.3'],
    ]);
    for (const about of [0.012, 0.3, 1, 4, 7, 99]) {
      const step = roundStep(about);
      expect(step).toBeGreaterThanOrEqual(0.999 * about);
      expect([1, 2, 5]).toContain(Number((step / 10 ** Math.floor(Math.log10(step) + 1e-9)).toFixed(6)));
    }
    for (const { at } of ticksOf({ ...plain, lo: 0.97, hi: 4.52 })) {
      expect(at).toBeGreaterThanOrEqual(0);
      expect(at).toBeLessThanOrEqual(1);
    }
  });

  it('of few whole numbers have a box for each, with its number in the middle', () => {
    const layers: Legend = { ...plain, lo: 1, hi: 3, whole: true, map: 'layers' };
    expect(new Set(boxesOf(layers).map(({ colour }) => colour)).size).toBe(3);
    expect(ticksOf(layers)).toEqual([1, 2, 3].map((n) => ({ at: (n - 0.5) / 3, text: String(n) })));
    expect(withCounts(layers, [1, 1, 2, 3, -1], (value) => value >= 0).counts).toEqual([2, 1, 1]);
    expect(boxesOf({ ...layers, lo: 3 })).toHaveLength(1);
  });

  it('of isochrones have a box a band and ticks at borders of bands', () => {
    const times: Legend = { ...plain, lo: 0, hi: 140, bands: 20 };
    expect(boxesOf(times)).toHaveLength(7);
    expect(ticksOf(times).map(({ text }) => text)).toEqual(['0', '40', '80', '120']);
  });

  it('say where values lie beyond their ends, and count those at the ends', () => {
    const shown = withCounts(plain, [20, 36, 63, 63.9, Number.NaN]);
    expect(shown.values).toEqual([20, 63.9]);
    expect(clipped(shown)).toEqual({ below: true, above: false });
    expect(shown.counts?.reduce((sum, count) => sum + count, 0)).toBe(4);
    expect(shown.counts?.at(0)).toBe(1);
    expect(clipped(plain)).toEqual({ below: false, above: false });
  });
});
