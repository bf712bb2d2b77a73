import { effect } from '@preact/signals';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { EngineClient } from '../../engine/client';
import type { Recipe, Schema } from '../../engine/contract';
import engineSchema from '../../engine/schema.json';
import { Workers } from '../../engine/testing/workers';
import { frameTimes, mayStimulate, simulatedPhysics, simulation } from '../run/frames';
import { cancelRun, runAll } from '../run/run_stages';
import { pauseSimulation, resumeSimulation, simulate } from '../run/simulate';
import { activity, schema } from '../run/stages';
import { volume } from './input';
import { openPhantom, startEngine } from './open_case';
import { addHeartbeat, addSimulation, meshedLabels, startingPhysics, stimulateAt } from './physics';
import { editRecipe, recipe, undo, undoLabel } from './recipe';

let workers: Workers;

beforeEach(async () => {
  vi.stubGlobal('history', { replaceState: () => undefined });
  vi.stubGlobal('location', { href: 'http://localhost/' });
  workers = new Workers();
  await startEngine(new EngineClient(workers.setup()));
  schema.value = { version: '', ...engineSchema } as unknown as Schema;
  await openPhantom({ kind: 'sphere' });
  await vi.waitFor(() => expect(activity.value).toBe('idle'), 5000);
});
afterEach(async () => {
  await cancelRun();
  workers.end();
  vi.unstubAllGlobals();
});

const name = (names: Record<number, string>) => {
  const labels = Object.entries(names).map(([label, text]) => ({
    label: Number(label),
    name: text,
    colour: null,
    voxels: 10,
  }));
  volume.value = volume.value && { ...volume.value, labels };
};

describe('the simulation that a case begins with', () => {
  it('knows scar and pools by their names, and that a border zone is slow', () => {
    name({ 1: 'LV wall', 2: 'RV wall', 3: 'LV blood pool', 5: 'Scar core', 6: 'Border zone' });
    const physics = startingPhysics(recipe.value as Recipe);
    expect(physics.tissue.kinds.map(({ labels }) => labels)).toEqual([[1, 2], [6]]);
    expect(physics.tissue.kinds[1].along_mm_per_ms).toBeLessThan(physics.tissue.kinds[0].along_mm_per_ms);
    expect(physics.stimuli).toHaveLength(1);
    expect(physics.monodomain).toMatchObject({ integration: 'semi_implicit', electrodes: [] });
  });

  it('takes all labels for tissue where no name tells', () => {
    name({ 4: '', 7: '' });
    expect(startingPhysics(recipe.value as Recipe).tissue.kinds.map(({ labels }) => labels)).toEqual([
      [4, 7],
    ]);
  });

  it('is of the labels that are meshed', () => {
    name({ 1: '', 2: '' });
    expect(meshedLabels({ ...(recipe.value as Recipe), labels: [2] })).toEqual([2]);
  });

  it("has every field at the engine's own value, and no group that was not asked for", () => {
    const { tissue, stimuli, monodomain, ...others } = startingPhysics(recipe.value as Recipe);
    expect(tissue.kinds[0]).toMatchObject({ cell: 'ms', tau_in_ms: 0.3, tau_close_ms: 150, gate: 0.13 });
    expect(stimuli[0]).toMatchObject({ shape: 'sphere', duration_ms: 2, count: 1, s2_ms: 0 });
    expect(monodomain).toMatchObject({ end_ms: 400, consistent_mass: 0.5 });
    expect(others).toEqual({});
  });
});

describe('the heartbeat that a case begins with', () => {
  it('brings fibres and where the cavities are, and beats by time alone where no wave is asked for', () => {
    name({ 1: '', 2: '' });
    editRecipe('None', (draft) => void delete draft.physics);
    addHeartbeat();
    const { anatomy, fibres, mechanics, tissue } = (recipe.value as Recipe).physics!;
    expect(anatomy).toBeDefined();
    expect(fibres).toMatchObject({ alpha_endo_deg: 60 });
    expect(mechanics).toMatchObject({ element: 'p1_anp', material: {}, labels: [], beats: 5 });
    expect(mechanics?.contraction).toMatchObject({ by: 'synchronous', preset: 'fast' });
    expect(mechanics?.windkessel).toMatchObject({ regurgitation: 0 });
    expect(tissue.kinds).toEqual([]);
  });

  it('stays when a wave is added, and beats by the map of one that was there', () => {
    name({ 1: '', 2: '' });
    editRecipe('None', (draft) => void delete draft.physics);
    addHeartbeat();
    addSimulation();
    expect((recipe.value as Recipe).physics).toMatchObject({ mechanics: { beats: 5 }, monodomain: {} });
    editRecipe('None', ({ physics }) => void delete physics?.mechanics);
    addHeartbeat();
    expect((recipe.value as Recipe).physics?.mechanics?.contraction.by).toBe('eikonal');
  });
});

describe('a stimulus given while a wave is computed', () => {
  it('is one edit of the case, at its time, and the wave goes on to its end', async () => {
    vi.stubGlobal('requestAnimationFrame', () => 0);
    await runAll();
    addSimulation();
    const before = recipe.value?.physics?.stimuli.length ?? 0;
    const run = simulate('monodomain');
    const stop = effect(() => void (frameTimes.value.length === 3 && pauseSimulation()));
    await vi.waitFor(() => expect(simulation.value).toBe('paused'), 5000);
    stop();
    expect(mayStimulate.value).toBe(true);
    await stimulateAt([1.26, 2, 3]);
    resumeSimulation();
    expect(undoLabel.value).toBe('Stimulate here');
    const given = recipe.value?.physics?.stimuli.at(-1);
    expect(given).toMatchObject({ name: 'Stimulus 2', centre_mm: [1.3, 2, 3], radius_mm: 5, count: 1 });
    expect(given?.start_ms).toBeGreaterThanOrEqual(15);
    await run;
    expect(simulatedPhysics.value?.stimuli).toHaveLength(before + 1);
    expect(simulation.value).toBe('done');
    expect(frameTimes.value).toHaveLength(20);
    expect(mayStimulate.value).toBe(false);
    undo();
    expect(recipe.value?.physics?.stimuli).toHaveLength(before);
  });
});
