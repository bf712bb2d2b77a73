import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { FieldInfo, Frame } from '../../engine/contract';
import { time } from '../view';
import {
  beginFrames,
  forgetFrames,
  frameShown,
  frameTimes,
  keepFrame,
  keptSimulation,
  playedFields,
  simulation,
} from './frames';
import { keepPlaying, play, playing, seek, stepFrame, stopPlaying, togglePlaying } from './player';

let turn: ((now: number) => void) | null = null;
vi.stubGlobal('requestAnimationFrame', (next: (now: number) => void) => {
  turn = next;
  return 1;
});
vi.stubGlobal('cancelAnimationFrame', () => (turn = null));
keepPlaying();

/** The screen draws at these times, ms. */
const draw = (...at: number[]) => {
  for (const now of at) turn?.(now);
};

function frame(timeMs: number, range: [number, number] = [0, 1]): Frame {
  const info = { name: 'u', title: 'U', unit: '1', on: 'points', scale: 'sequential', range } as FieldInfo;
  return { timeMs, fields: [info], values: { u: new Float32Array([timeMs]) } };
}

beforeEach(() => {
  stopPlaying();
  forgetFrames();
  simulation.value = 'done';
  for (const timeMs of [0, 10, 20, 30]) keepFrame(frame(timeMs));
});
afterEach(stopPlaying);

describe('frames', () => {
  it('are shown at the time cursor', () => {
    expect(frameShown.value?.timeMs).toBe(0);
    time.value = 19.9;
    expect(frameShown.value?.timeMs).toBe(10);
    expect(frameTimes.value).toEqual([0, 10, 20, 30]);
  });

  it('have one range over all of them, which stays the same object while it holds', () => {
    expect(playedFields.value[0].range).toEqual([0, 1]);
    const before = playedFields.value;
    keepFrame(frame(40, [0.2, 0.8]));
    expect(playedFields.value).toBe(before);
    keepFrame(frame(50, [-0.1, 0.5]));
    expect(playedFields.value[0].range).toEqual([-0.1, 1]);
  });

  it('of a run that goes on from some time stand behind those before it', () => {
    beginFrames('monodomain', 0);
    expect(frameTimes.value).toEqual([]);
    for (const timeMs of [0, 10, 14]) keepFrame(frame(timeMs));
    beginFrames('monodomain', 14);
    for (const timeMs of [20, 30]) keepFrame(frame(timeMs));
    expect(frameTimes.value).toEqual([0, 10, 20, 30]);
    beginFrames('diffusion', 40);
    expect(frameTimes.value).toEqual([]);
  });

  it('of a run that begins anew leave those of the one before to whoever keeps them', () => {
    beginFrames('monodomain', 0);
    for (const timeMs of [0, 10]) keepFrame(frame(timeMs));
    const { frames } = keptSimulation();
    beginFrames('monodomain', 0);
    expect(frames.at(30)?.timeMs).toBe(10);
  });

  it('are gone with the mesh that they are of', () => {
    forgetFrames();
    expect(frameShown.value).toBeNull();
    expect(simulation.value).toBe('none');
  });
});

describe('the player', () => {
  it('goes from the first frame to the last in six seconds, and stops there', () => {
    play();
    draw(1000, 4000);
    expect(time.value).toBeCloseTo(15, 6);
    expect(playing.value).toBe(true);
    draw(7000);
    expect(time.value).toBe(30);
    expect(playing.value).toBe(false);
  });

  it('begins anew where it stands at the end, and goes on where it does not', () => {
    time.value = 30;
    play();
    expect(time.value).toBe(0);
    togglePlaying();
    time.value = 20;
    togglePlaying();
    expect(time.value).toBe(20);
  });

  it('steps from frame to frame, not beyond the ends', () => {
    time.value = 12;
    stepFrame(1);
    expect(time.value).toBe(20);
    stepFrame(-1);
    stepFrame(-1);
    stepFrame(-1);
    expect(time.value).toBe(0);
    time.value = 30;
    stepFrame(1);
    expect(time.value).toBe(30);
  });

  it('stops where the cursor is moved by hand', () => {
    play();
    seek(99);
    expect(playing.value).toBe(false);
    expect(time.value).toBe(30);
  });

  it('follows the newest frame while the simulation goes on, unless it was stopped', () => {
    simulation.value = 'running';
    play();
    keepFrame(frame(40));
    expect(time.value).toBe(40);
    stepFrame(-1);
    keepFrame(frame(50));
    expect(time.value).toBe(30);
    play();
    expect(time.value).toBe(50);
  });

  it('goes round with a heart, but waits at its end once it has been computed', () => {
    simulation.value = 'running';
    beginFrames('mechanics', 0);
    for (const timeMs of [0, 10, 20, 30]) keepFrame(frame(timeMs));
    play();
    simulation.value = 'done';
    draw(1000);
    expect(playing.value).toBe(false);
    play();
    draw(2000, 8000);
    expect(time.value).toBe(0);
    expect(playing.value).toBe(true);
    draw(11000);
    expect(time.value).toBeCloseTo(15, 6);
  });

  it('goes on by itself where the simulation that it follows is held or cut off', () => {
    simulation.value = 'running';
    play();
    time.value = 10;
    simulation.value = 'cancelled';
    draw(0, 1000);
    expect(time.value).toBeCloseTo(15, 6);
  });
});
