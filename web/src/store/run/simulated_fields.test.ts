import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { noValue, type FieldInfo, type Recipe, type Report, type StageArrays } from '../../engine/contract';
import { colourBy, time } from '../view';
import { pinRun, unpin } from './compare';
import { forgetFound, forgetFrames, keepFound, keepFrame } from './frames';
import { phaseDegrees } from './phase';
import { meshedRecipe, report } from './report';
import { keepResult, showResult } from './results';
import {
  beatShown,
  comparedFields,
  differenceFound,
  pinnedValues,
  showBeat,
  simulatedFields,
  simulatedValues,
} from './simulated_fields';

const info = (name: string, change: Partial<FieldInfo> = {}): FieldInfo => ({
  name,
  title: name === 'activation_ms' ? 'Activation time' : name,
  unit: 'ms',
  on: 'points',
  scale: 'sequential',
  components: 1,
  count: 3,
  range: [0, 1],
  ...change,
});
const voltage = info('voltage_mV', { unit: 'mV', range: [-80, 20] });
const frame = (timeMs: number, ...values: number[]) =>
  keepFrame({ timeMs, fields: [voltage], values: { voltage_mV: Float32Array.from(values) } });
const activated = (...values: number[]) =>
  keepFound({ fields: [info('activation_ms')], values: { activation_ms: Float32Array.from(values) } });

/** A mesh of this key is shown, with its report. */
function mesh(key: string): void {
  keepResult('optimise', key, { labels: new Uint16Array(1) } as Partial<StageArrays['optimise']>);
  showResult('optimise', key);
  report.value = { digest: key } as Report;
  meshedRecipe.value = {} as Recipe;
}

beforeEach(() => mesh('one'));
afterEach(() => {
  unpin();
  forgetFrames();
  forgetFound();
  colourBy.value = 'label';
});

describe('the phase', () => {
  it('goes around with an action potential: rest, front, excited, recovery', () => {
    const [rest, high] = [-80, 20];
    const now = Float32Array.of(rest, high, high, rest, noValue);
    const before = Float32Array.of(rest, rest, high, high, high);
    expect([...phaseDegrees(now, before)].map(Math.round)).toEqual([
      -135,
      -45,
      45,
      135,
      Math.fround(noValue),
    ]);
  });

  it('is that of the frame at the cursor and the one 20 ms before it', () => {
    for (const [timeMs, value] of [
      [0, -80],
      [10, 20],
      [20, 20],
      [30, 20],
      [40, -80],
    ])
      frame(timeMs, value, value, value);
    const at = (now: number) => {
      time.value = now;
      return Math.round(simulatedValues('phase_deg')![0]);
    };
    expect([0, 10, 20, 30, 40].map(at)).toEqual([-135, -45, -45, 45, 135]);
    expect(simulatedFields.value.map((field) => field.info.scale)).toEqual(['sequential', 'cyclic']);
  });

  it('is none without a voltage', () => {
    activated(1, 2, 3);
    expect(simulatedFields.value.map((field) => field.info.name)).toEqual(['activation_ms']);
  });
});

/** So many activations of a point, each with its time of recovery, and two fields of no beat. */
function beats(...times: number[]): void {
  const later = times.slice(1).flatMap((_, i) => [`activation_${i + 2}_ms`, `repolarisation_${i + 2}_ms`]);
  const names = ['activation_ms', 'repolarisation_ms', 'last_activation_ms', 'activations', ...later];
  const value = (name: string) => times[Number(/_(\d+)_/.exec(name)?.[1] ?? 1) - 1];
  keepFound({
    fields: names.map((name) => info(name)),
    values: Object.fromEntries(names.map((name) => [name, Float32Array.of(value(name))])),
  });
}
const offered = () => simulatedFields.value.map((field) => field.info.name);

describe('beats of a point', () => {
  it('after the first are offered one at a time: the one that is shown', () => {
    beats(10, 210, 410);
    const first = ['activation_ms', 'repolarisation_ms', 'last_activation_ms', 'activations'];
    expect(offered()).toEqual(first);
    colourBy.value = 'activation_ms';
    expect(beatShown.value).toEqual({ beat: 1, count: 3 });
    showBeat(3);
    expect(colourBy.value).toBe('activation_3_ms');
    expect(beatShown.value).toEqual({ beat: 3, count: 3 });
    expect(offered()).toEqual([...first, 'activation_3_ms']);
    expect(simulatedValues(colourBy.value)?.[0]).toBe(410);
    showBeat(1);
    expect(colourBy.value).toBe('activation_ms');
    expect(offered()).toEqual(first);
  });

  it('are none of what has only one', () => {
    beats(10, 210);
    for (const name of ['label', 'activations', 'last_activation_ms', 'edge_mm']) {
      colourBy.value = name;
      expect(beatShown.value.count).toBeLessThan(2);
    }
    beats(10);
    colourBy.value = 'activation_ms';
    expect(beatShown.value).toEqual({ beat: 1, count: 1 });
  });

  it('of an earlier simulation give way to a first beat, not to another later one', () => {
    beats(10, 210, 410);
    beats(20, 220);
    colourBy.value = 'activation_ms';
    expect(beatShown.value.count).toBe(2);
    expect(simulatedValues('activation_3_ms')).toBeUndefined();
    keepFound({ fields: [info('activation_2_ms')], values: { activation_2_ms: Float32Array.of(230) } });
    expect(simulatedValues('activation_2_ms')?.[0]).toBe(230);
    expect(simulatedValues('activation_ms')?.[0]).toBe(20);
  });

  it('are compared with those of a pinned run', () => {
    beats(10, 210);
    pinRun();
    beats(11, 214, 420);
    colourBy.value = 'difference_activation_ms';
    expect(beatShown.value).toEqual({ beat: 1, count: 3 });
    showBeat(2);
    expect(colourBy.value).toBe('difference_activation_2_ms');
    expect([...simulatedValues(colourBy.value)!]).toEqual([4]);
    expect(offered()).toContain('difference_activation_2_ms');
    expect(comparedFields.value.map((field) => field.info.name)).not.toContain('repolarisation_2_ms');
    // The pinned run has no third beat.
    showBeat(3);
    expect(offered()).not.toContain('difference_activation_3_ms');
  });

  it('that stand alone, from a file, are offered always', () => {
    keepFound({ fields: [info('activation_2_ms')], values: { activation_2_ms: Float32Array.of(230) } });
    expect(offered()).toEqual(['activation_2_ms']);
  });
});

describe('the difference to a pinned run', () => {
  it('is this run less the pinned one where both have a value, with its figures and a scale around 0', () => {
    activated(10, 20, noValue);
    pinRun();
    expect(comparedFields.value).toEqual([]);
    activated(13, 16, 30);
    const found = differenceFound('activation_ms')!;
    expect([...found.values]).toEqual([3, -4, Math.fround(noValue)]);
    expect(found).toMatchObject({ largest: 4, mean: -0.5, both: 2, one: 1 });
    expect(found.rms).toBeCloseTo(Math.sqrt(12.5), 6);
    const field = simulatedFields.value.at(-1)!;
    expect(field.info).toMatchObject({ title: 'Difference of activation time', scale: 'diverging' });
    expect(field.range).toEqual([-4, 4]);
    expect(simulatedValues('difference_activation_ms')).toBe(found.values);
  });

  it('of what is played is taken at the time of the cursor', () => {
    frame(0, -80, -80, -80);
    frame(10, 20, -80, -80);
    pinRun();
    forgetFrames();
    frame(0, -80, -80, -80);
    frame(10, -80, 20, -80);
    time.value = 10;
    expect([...pinnedValues('voltage_mV')!]).toEqual([20, -80, -80]);
    expect([...simulatedValues('difference_voltage_mV')!]).toEqual([-100, 100, 0]);
    time.value = 0;
    expect([...simulatedValues('difference_voltage_mV')!]).toEqual([0, 0, 0]);
  });

  it('is none on another mesh, nor when nothing is pinned', () => {
    activated(1, 2, 3);
    pinRun();
    activated(2, 3, 4);
    expect(comparedFields.value).toHaveLength(1);
    mesh('two');
    expect(comparedFields.value).toEqual([]);
    expect(differenceFound('activation_ms')).toBeUndefined();
    mesh('one');
    expect(comparedFields.value).toHaveLength(1);
    unpin();
    expect(comparedFields.value).toEqual([]);
  });
});
