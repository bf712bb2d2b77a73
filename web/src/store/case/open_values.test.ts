import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { EngineClient } from '../../engine/client';
import { Workers } from '../../engine/testing/workers';
import { dismiss, notices } from '../notices';
import { foundFields, frameTimes, playedFields, simulation } from '../run/frames';
import { stopPlaying } from '../run/player';
import { forgetReport, report } from '../run/report';
import { cancelRun, runAll } from '../run/run_stages';
import { simulatedValues } from '../run/simulated_fields';
import { activity } from '../run/stages';
import { colourBy, time } from '../view';
import { openPhantom, startEngine } from './open_case';
import { dropFiles, openFiles } from './open_files';

let workers: Workers;

const valuesOf = (name: string, frames: readonly number[], points = report.value?.points ?? 0) =>
  new File([new Uint8Array(frames.flatMap((value) => Array<number>(points).fill(value)))], name);

beforeEach(async () => {
  vi.stubGlobal('history', { replaceState: () => undefined });
  vi.stubGlobal('location', { href: 'http://localhost/' });
  vi.stubGlobal('requestAnimationFrame', () => 0);
  vi.stubGlobal('cancelAnimationFrame', () => undefined);
  workers = new Workers();
  await startEngine(new EngineClient(workers.setup()));
  for (const { id } of notices.value) dismiss(id);
  await openPhantom({ kind: 'sphere' });
  await runAll();
  await vi.waitFor(() => expect(activity.value).toBe('idle'), 5000);
});
afterEach(async () => {
  stopPlaying();
  await cancelRun();
  forgetReport();
  workers.end();
  vi.unstubAllGlobals();
});

describe('values that were found elsewhere', () => {
  it('of a .dat become a colour of the mesh', async () => {
    await dropFiles([valuesOf('heart.activation_ms.dat', [7])]);
    expect(notices.value).toEqual([]);
    expect(foundFields.value.map(({ info }) => info.name)).toEqual(['activation_ms']);
    expect(colourBy.value).toBe('activation_ms');
    expect(simulatedValues('activation_ms')?.[0]).toBe(7);
    expect(frameTimes.value).toEqual([]);
    expect(activity.value).toBe('idle');
  });

  it('of an .igb are played as frames', async () => {
    await openFiles([valuesOf('vm.igb', [1, 2, 4])]);
    expect(frameTimes.value).toEqual([0, 5, 10]);
    expect(playedFields.value[0].range).toEqual([1, 4]);
    expect(simulation.value).toBe('done');
    time.value = 5;
    expect(simulatedValues('vm')?.[0]).toBe(2);
    await openFiles([valuesOf('vm.igb', [9])]);
    expect(frameTimes.value).toEqual([0]);
    expect(playedFields.value[0].range).toEqual([9, 9]);
  });

  it('are refused where they are of another mesh', async () => {
    const { points = 0 } = report.value ?? {};
    await dropFiles([valuesOf('lat.dat', [1], points + 1)]);
    expect(notices.value[0].text).toContain(`lat.dat: found ${points + 1} values, expected ${points}`);
    expect(foundFields.value).toEqual([]);
    expect(activity.value).toBe('idle');
  });

  it('wait for a mesh', async () => {
    forgetReport();
    await dropFiles([valuesOf('vm.igb', [1], 5)]);
    expect(notices.value[0].text).toContain(
      'vm.igb holds values at the points of a mesh: mesh the case first',
    );
  });
});
