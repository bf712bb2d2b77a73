import { describe, expect, it } from 'vitest';
import type { Simulated, VentricleBeat } from '../engine/contract';
import { excitation, heartbeat } from './simulated_values';

const beat = (end_diastolic_ml: number, end_systolic_ml: number): VentricleBeat => ({
  end_diastolic_ml,
  end_systolic_ml,
  stroke_ml: end_diastolic_ml - end_systolic_ml,
  ejection_fraction: 1 - end_systolic_ml / end_diastolic_ml,
  most_kpa: 16,
  stroke_work_j: 1.1,
});

const found: Simulated = {
  eikonal: { last_ms: 113, activated: 0.5 },
  mechanics: {
    end_ms: 1600,
    frames: 161,
    beats: [
      { lv: beat(140, 50), rv: beat(90, 30) },
      { lv: beat(120, 60), rv: beat(80, 20) },
    ],
    has_cycle: true,
    change_percent: 0.4,
    steps: 380,
    newton_iterations: 1000,
    traces: { times_ms: [], lines: [] },
  },
};

const read = (name: string, simulated: Simulated) =>
  [...excitation, ...heartbeat].find(([one]) => one === name)![3](simulated);

describe('what a lesson asks of a heart that beats', () => {
  it('is of the last beat, of the ventricle that it names', () => {
    expect(read('beat.lv_end_diastolic_ml', found)).toBe(120);
    expect(read('beat.rv_end_systolic_ml', found)).toBe(20);
    expect(read('beat.lv_ejection_percent', found)).toBeCloseTo(50);
    expect(read('beat.rv_ejection_percent', found)).toBeCloseTo(75);
    expect(read('beat.lv_stroke_ml', found)).toBe(60);
    expect(read('beat.count', found)).toBe(2);
    expect(read('beat.change_percent', found)).toBe(0.4);
  });

  it('is nothing where it has not beaten', () => {
    for (const [, , , of] of heartbeat) expect(of({ eikonal: found.eikonal })).toBeUndefined();
  });
});

it('an activation map has its time and its share in percent', () => {
  expect(read('wave.last_ms', found)).toBe(113);
  expect(read('wave.activated_percent', found)).toBe(50);
  expect(read('wave.total_ms', found)).toBeUndefined();
});
