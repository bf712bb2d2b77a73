import { describe, expect, it } from 'vitest';
import type { Traces } from '../../../engine/contract';
import { axisMarks, beatsOf, loopOf, nearestTime, placeAt, tracesCsv } from './loops';

const line = (name: string, unit: string, values: number[]) => ({ name, title: name, unit, values });

/** Filling, and two beats of 100 ms. */
const traces: Traces = {
  times_ms: [-50, 0, 50, 100, 150, 200],
  lines: [
    line('lv_volume', 'ml', [60, 100, 50, 98, 49, 97]),
    line('lv_pressure', 'kPa', [0, 1, 15, 1.2, 14, 1.3]),
    line('systemic_flow', 'ml/s', [0, 1, 2, 3, 4, 5]),
  ],
};

describe('a pressure-volume loop', () => {
  it('begins with the first beat, when the ventricle is filled', () => {
    expect(loopOf(traces, 'lv')).toEqual({
      times_ms: [0, 50, 100, 150, 200],
      ml: [100, 50, 98, 49, 97],
      kpa: [1, 15, 1.2, 14, 1.3],
    });
  });

  it('is none of a ventricle that nothing was recorded of, and none while it is filled', () => {
    expect(loopOf(traces, 'rv')).toBeNull();
    const filling = {
      times_ms: [-50, -45],
      lines: traces.lines.map((one) => ({ ...one, values: one.values.slice(0, 2) })),
    };
    expect(loopOf(filling, 'lv')).toBeNull();
  });

  it('is cut into beats that hang together; the last may be under way', () => {
    const loop = loopOf(traces, 'lv')!;
    expect(beatsOf(loop, 100).map(({ times_ms }) => times_ms)).toEqual([
      [0, 50, 100],
      [100, 150, 200],
    ]);
    expect(beatsOf(loop, 100)[1].ml).toEqual([98, 49, 97]);
    expect(beatsOf(loop, 150).map(({ times_ms }) => times_ms)).toEqual([
      [0, 50, 100, 150],
      [150, 200],
    ]);
    expect(beatsOf(loop, 100 + 1e-9)).toHaveLength(2);
  });

  it('has a place at each time, and a time near each place', () => {
    const loop = loopOf(traces, 'lv')!;
    expect(placeAt(loop, 25)).toEqual({ ml: 75, kpa: 8 });
    expect(placeAt(loop, -5)).toEqual({ ml: 100, kpa: 1 });
    expect(placeAt(loop, 500)).toEqual({ ml: 97, kpa: 1.3 });
    expect(nearestTime(loop, { ml: 51, kpa: 15 }, { ml: 1, kpa: 10 })).toBe(50);
    expect(nearestTime(loop, { ml: 49, kpa: 14 }, { ml: 1, kpa: 10 })).toBe(150);
  });
});

describe('marks of an axis', () => {
  it('are whole steps around all values', () => {
    expect(axisMarks(49, 100, 5)).toEqual([40, 60, 80, 100]);
    expect(axisMarks(0, 15.2, 4)).toEqual([0, 5, 10, 15, 20]);
    expect(axisMarks(0, 0.31, 4)).toEqual([0, 0.1, 0.2, 0.3, 0.4]);
  });

  it('are two where there is one value', () => {
    expect(axisMarks(50, 50, 5).length).toBeGreaterThan(1);
  });
});

describe('the file of what was recorded', () => {
  it('has a column for each line, named with its unit, and a row for each time', () => {
    const rows = tracesCsv(traces).trimEnd().split('\n');
    expect(rows[0]).toBe('time_ms,lv_volume_ml,lv_pressure_kPa,systemic_flow_ml_per_s');
    expect(rows).toHaveLength(7);
    expect(rows[2]).toBe('0,100,1,1');
  });
});
