import { beforeEach, describe, expect, it } from 'vitest';
import type { Frame, Physics, Report, Traces, VentricleBeat } from '../../../engine/contract';
import {
  beginFrames,
  endFrames,
  forgetFound,
  forgetFrames,
  frameTimes,
  keepFrame,
  showFrames,
  simulatedPhysics,
  simulation,
  simulationReport,
} from '../frames';
import {
  dropBeat,
  heartFound,
  heartIsPlayed,
  heartTraces,
  keepBeat,
  keptBeats,
  renameBeat,
} from './heartbeat';

const traces = (times_ms: number[]): Traces => ({
  times_ms,
  lines: [{ name: 'lv_volume', title: 'V', unit: 'ml', values: times_ms.map((time) => 100 - time) }],
});

const frame = (timeMs: number, recorded?: Traces): Frame => ({
  timeMs,
  fields: [],
  values: {},
  traces: recorded,
});

const beat: VentricleBeat = {
  end_diastolic_ml: 100,
  end_systolic_ml: 50,
  stroke_ml: 50,
  ejection_fraction: 0.5,
  most_kpa: 15,
  stroke_work_j: 0.7,
};

function reported(recorded: Traces): void {
  const mechanics = {
    end_ms: 20,
    frames: 2,
    beats: [{ lv: beat, rv: beat }],
    has_cycle: false,
    steps: 4,
    newton_iterations: 9,
    traces: recorded,
  };
  simulationReport.value = { simulation: { mechanics } } as Report;
}

beforeEach(() => {
  forgetFrames();
  forgetFound();
  keptBeats.value = [];
  simulatedPhysics.value = { mechanics: { period_ms: 800 } } as Physics;
  simulation.value = 'running';
  beginFrames('mechanics', 0);
  keepFrame(frame(0, traces([-5, 0])));
});

describe('what a heart has recorded', () => {
  it('grows with each frame, and holds what was before its first', () => {
    keepFrame(frame(10, traces([5, 10])));
    expect(heartTraces.value?.times_ms).toEqual([-5, 0, 5, 10]);
    expect(heartTraces.value?.lines[0].values).toEqual([105, 100, 95, 90]);
    expect(heartIsPlayed.value).toBe(true);
  });

  it('of a run that goes on from an earlier time is told anew from there', () => {
    keepFrame(frame(10, traces([5, 10])));
    keepFrame(frame(20, traces([15, 20])));
    beginFrames('mechanics', 20);
    keepFrame(frame(20, { ...traces([15, 20]), lines: [{ ...traces([]).lines[0], values: [1, 2] }] }));
    expect(frameTimes.value).toEqual([0, 10, 20]);
    expect(heartTraces.value?.times_ms).toEqual([-5, 0, 5, 10, 15, 20]);
    expect(heartTraces.value?.lines[0].values.slice(-3)).toEqual([90, 1, 2]);
  });

  it('has its figures only at its end: those of the run before are of other loops', () => {
    reported(traces([0]));
    expect(heartFound.value).toBeNull();
    simulation.value = 'done';
    expect(heartFound.value?.beats[0].lv.stroke_ml).toBe(50);
  });

  it('is still at hand when a wave is played, and its frames come back with it', () => {
    endFrames('mechanics', 'a');
    simulation.value = 'done';
    reported(traces([-5, 0]));
    beginFrames('monodomain', 0);
    keepFrame(frame(0));
    keepFrame(frame(1));
    expect(heartIsPlayed.value).toBe(false);
    expect(heartTraces.value?.times_ms).toEqual([-5, 0]);
    showFrames('mechanics', 'a');
    expect(heartIsPlayed.value).toBe(true);
    expect(frameTimes.value).toEqual([0]);
  });

  it('is not shown for a result of another key', () => {
    endFrames('mechanics', 'a');
    showFrames('mechanics', 'b');
    expect(frameTimes.value).toEqual([]);
  });
});

describe('runs that are kept', () => {
  beforeEach(() => {
    simulation.value = 'done';
    reported(traces([-5, 0]));
  });

  it('have names, or numbers where none is given, and can be renamed and dropped', () => {
    keepBeat('healthy');
    keepBeat(' ');
    const [first, second] = keptBeats.value;
    expect(first.name).toBe('healthy');
    expect(second.name).toMatch(/^Run \d+$/);
    renameBeat(first.id, 'at rest');
    dropBeat(second.id);
    expect(keptBeats.value.map(({ name }) => name)).toEqual(['at rest']);
  });

  it('stay as they were when the next one is computed', () => {
    keepBeat('healthy');
    simulation.value = 'running';
    beginFrames('mechanics', 0);
    keepFrame(frame(0, traces([-3, 0])));
    expect(keptBeats.value[0].traces.times_ms).toEqual([-5, 0]);
    expect(keptBeats.value[0].periodMs).toBe(800);
    keepBeat('not done');
    expect(keptBeats.value).toHaveLength(1);
  });
});
