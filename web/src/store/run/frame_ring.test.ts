import fc from 'fast-check';
import { expect, it } from 'vitest';
import type { Frame } from '../../engine/contract';
import { FrameRing } from './frame_ring';

/** 100 bytes. */
const frame = (timeMs: number): Frame => ({ timeMs, fields: [], values: { u: new Float32Array(25) } });

function filled(maxBytes: number, count: number): FrameRing {
  const ring = new FrameRing(maxBytes);
  for (let i = 0; i < count; i++) ring.push(frame(i));
  return ring;
}

it('keeps every frame while there is room', () => {
  expect(filled(1000, 10).times).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
});

it('drops every second frame when there are too many, and goes on at that pace', () => {
  expect(filled(500, 6).times).toEqual([0, 2, 4, 5]);
  expect(filled(500, 7).times).toEqual([0, 2, 4, 6]);
  expect(filled(500, 9).times).toEqual([0, 2, 4, 6, 8]);
  expect(filled(500, 11).times).toEqual([0, 4, 8, 10]);
});

it('keeps the first and the newest, and an even choice between them, within its bytes', () => {
  fc.assert(
    fc.property(fc.integer({ min: 3, max: 40 }), fc.integer({ min: 1, max: 500 }), (room, count) => {
      const ring = filled(100 * room, count);
      const { times } = ring;
      expect(ring.bytes).toBe(100 * times.length);
      expect(ring.bytes).toBeLessThanOrEqual(100 * room);
      expect(times[0]).toBe(0);
      expect(times.at(-1)).toBe(count - 1);
      expect(times.length).toBeGreaterThanOrEqual(Math.min(count, room / 2));
      const gaps = times.slice(1).map((time, i) => time - times[i]);
      expect(new Set(gaps.slice(0, -1)).size).toBeLessThanOrEqual(1);
    }),
  );
});

it('keeps two frames even where one has more bytes than there is room for', () => {
  expect(filled(50, 5).times).toEqual([0, 4]);
});

it('gives the last frame that is not after a time', () => {
  const ring = filled(1000, 4);
  expect([-1, 0, 0.9, 1, 7].map((time) => ring.at(time)?.timeMs)).toEqual([0, 0, 0, 1, 3]);
  expect(new FrameRing(10).at(0)).toBeNull();
});
