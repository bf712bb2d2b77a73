import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { EngineClient } from '../../engine/client';
import { EngineError, type Forecast, type Recipe } from '../../engine/contract';
import { useEngine } from './engine';
import { exceeded, exceededOf, fitSizes, forecast, keepForecast, rounded, useSizes } from './forecast';
import { editRecipe, recipe, startRecipe, undo } from '../case/recipe';
import { activity, blankStages, previewDue, setStage, stages } from './stages';
import { runTo } from './run_stages';
import { stageInput } from './stage_inputs';

const of = (tets: number): Forecast => ({
  tets,
  points: 1,
  triangles: 1,
  peak_mb: 70,
  seconds: 2,
  seconds_here: [1, 3],
});
const cancelled = () => new EngineError({ code: 'cancelled', stage: 'engine', message: '' });
const sizingOf = (json: string) => (JSON.parse(json) as Recipe).sizing;

let cases = 0;
/** What the engine has been asked, each to be answered by the test. */
let questions: { edge: number; answer(found: object): void; fail(error: Error): void }[] = [];
const engine = {
  busy: false,
  cancel: vi.fn(async () => 0),
  run: vi.fn(() => new Promise(() => undefined)),
  forecast: vi.fn(
    (json: string) =>
      new Promise((answer, fail) => questions.push({ edge: sizingOf(json).edge_mm, answer, fail })),
  ),
};
const edge = (mm: number) => editRecipe('Edge', (draft) => void (draft.sizing.edge_mm = mm));
/** The label surface of the recipe as it stands is there. */
const surfaced = () => setStage('smooth', { state: 'done', madeFrom: stageInput(recipe.value!, 'smooth') });
const wait = () => vi.advanceTimersByTimeAsync(200);

keepForecast();
beforeEach(() => {
  vi.useFakeTimers();
  vi.clearAllMocks();
  questions = [];
  engine.busy = false;
  useEngine(engine as unknown as EngineClient);
  activity.value = 'opening';
  stages.value = blankStages();
  startRecipe({
    // Another case in each test: an answer to the last one is none.
    source: { phantom: { kind: 'sphere', seed: ++cases } },
    sizing: { edge_mm: 2, labels: [{ label: 1, edge_mm: 1 }], masks: [], images: [] },
    limits: { tets: 0, memory_mb: 0, seconds: 0 },
  } as unknown as Recipe);
  surfaced();
});
afterEach(async () => {
  activity.value = 'opening';
  for (const { fail } of questions) fail(cancelled());
  await wait();
  vi.useRealTimers();
});

describe('the forecast', () => {
  it('tells what it was before the last step, whatever came between while that was dragged', async () => {
    activity.value = 'idle';
    await wait();
    questions[0].answer(of(1000));
    await wait();
    expect(forecast.value?.was ?? null).toBe(null);
    for (const [mm, tets] of [
      [1.8, 1200],
      [1.5, 1500],
    ]) {
      editRecipe('Edge', (draft) => void (draft.sizing.edge_mm = mm), 'drag', Infinity);
      await wait();
      questions.at(-1)!.answer(of(tets));
      await wait();
      expect(forecast.value?.numbers?.tets).toBe(tets);
      expect(forecast.value?.was?.tets).toBe(1000);
    }
  });

  it('is asked for once the label surface is there and the engine is free', async () => {
    stages.value = blankStages();
    activity.value = 'idle';
    await wait();
    expect(questions).toHaveLength(0);
    activity.value = 'preview';
    surfaced();
    await wait();
    expect(questions).toHaveLength(0);
    activity.value = 'idle';
    await wait();
    questions[0].answer(of(1000));
    await wait();
    expect(forecast.value).toEqual({ numbers: of(1000), problem: '', was: null, fresh: true });
    await wait();
    expect(questions).toHaveLength(1);
  });

  it('follows a drag, one question at a time, and ends with the last recipe', async () => {
    activity.value = 'idle';
    await wait();
    for (const mm of [3, 4, 5]) {
      edge(mm);
      await wait();
    }
    expect(questions.map((question) => question.edge)).toEqual([2]);
    questions[0].answer(of(1000));
    await wait();
    expect(forecast.value).toMatchObject({ numbers: of(1000), fresh: false });
    expect(questions.map((question) => question.edge)).toEqual([2, 5]);
    questions[1].answer(of(500));
    await wait();
    expect(forecast.value).toMatchObject({ numbers: of(500), fresh: true });
  });

  it('of another surface is none, and one that cannot be made says why, once', async () => {
    activity.value = 'idle';
    await wait();
    questions[0].fail(new Error('the wall has one side'));
    await wait();
    expect(forecast.value).toMatchObject({ numbers: null, problem: 'the wall has one side' });
    expect(questions).toHaveLength(1);
    editRecipe('Labels', (draft) => void (draft.labels = [1]));
    expect(forecast.value).toBeNull();
  });

  it('that was overtaken is asked for again afterwards', async () => {
    activity.value = 'idle';
    await wait();
    activity.value = 'opening';
    questions[0].fail(cancelled());
    await wait();
    expect(questions).toHaveLength(1);
    activity.value = 'idle';
    await wait();
    expect(questions).toHaveLength(2);
  });

  it('that takes long leaves an edit to its preview first', async () => {
    activity.value = 'idle';
    await wait();
    await vi.advanceTimersByTimeAsync(1000);
    questions[0].answer(of(1000));
    await wait();
    previewDue.value = true;
    edge(3);
    await wait();
    expect(questions).toHaveLength(1);
    previewDue.value = false;
    await wait();
    questions[1].answer(of(500));
    await wait();
    previewDue.value = true;
    edge(4);
    await wait();
    expect(questions).toHaveLength(3);
    previewDue.value = false;
  });

  it('is waited for by a run from the same surface, and ended by one from another', async () => {
    activity.value = 'idle';
    await wait();
    engine.busy = true;
    void runTo('quality');
    await wait();
    expect(activity.value).toBe('run');
    expect(engine.run).not.toHaveBeenCalled();
    engine.busy = false;
    questions[0].answer(of(1000));
    await wait();
    expect(engine.run).toHaveBeenCalledOnce();
    expect(engine.cancel).not.toHaveBeenCalled();

    edge(3);
    activity.value = 'idle';
    await wait();
    engine.busy = true;
    editRecipe('Labels', (draft) => void (draft.labels = [1]));
    void runTo('smooth');
    await wait();
    expect(engine.cancel).toHaveBeenCalledOnce();
  });
});

it('limits of 0 limit nothing; others name what exceeds them', async () => {
  const limits = { tets: 900, memory_mb: 70, seconds: 0 };
  expect(exceededOf(of(1000), limits)).toEqual([{ field: 'tets', found: 1000, limit: 900 }]);
  activity.value = 'idle';
  await wait();
  questions[0].answer(of(1000));
  await wait();
  expect(exceeded.value).toEqual([]);
  editRecipe('Limit', (draft) => void (draft.limits.tets = 900));
  expect(exceeded.value).toHaveLength(1);
  await wait();
  expect(questions).toHaveLength(1);
});

it('sizes for a number of tetrahedra are one step of undo, four digits of each', async () => {
  const { signal } = new AbortController();
  const asked = fitSizes(5000, signal);
  const before = recipe.value!.sizing;
  const fitted = { ...before, edge_mm: 1.23456, labels: [{ label: 1, edge_mm: 0.617283 }] };
  const fitting = { factor: 0.617283, edge_mm: 1.23456, sizing: fitted, forecast: of(4990) };
  questions[0].answer({ ...of(1000), fitting });
  const found = await asked;
  expect(engine.forecast).toHaveBeenLastCalledWith(expect.anything(), expect.anything(), 5000, signal);
  useSizes(found, 5000);
  expect(recipe.value!.sizing).toEqual({
    ...before,
    edge_mm: 1.235,
    labels: [{ label: 1, edge_mm: 0.6173 }],
  });
  undo();
  expect(recipe.value!.sizing).toEqual(before);
});

it('rounding leaves what has not changed', () => {
  expect(rounded({ a: 0.123456, b: [1, 2], c: 'x' }, { a: 0.123456, b: [1, 2.000049], c: 'x' })).toEqual({
    a: 0.123456,
    b: [1, 2],
    c: 'x',
  });
});
