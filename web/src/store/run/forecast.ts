/** What meshing will take, as the engine foretells it: it follows the recipe whenever the engine is free. */
import { computed, effect, signal } from '@preact/signals';
import { EngineError, type FittingSizes, type Forecast, type Recipe } from '../../engine/contract';
import { engine } from './engine';
import { editRecipe, recipe, stepCount } from '../case/recipe';
import { activity, previewDue, isMadeFrom } from './stages';
import { awaitedSides } from '../case/side_files';
import { stageInput } from './stage_inputs';

/** The engine's latest answer, or why there is none, and what of the recipe it was asked for. */
interface Answer {
  surface: string;
  input: string;
  numbers: Forecast | null;
  problem: string;
}

const answer = signal<Answer | null>(null);
/** The answer before the last step of the recipe's history, and how many steps there were with the newest. */
let before: { steps: number; answer: Answer | null } = { steps: 0, answer: null };
/** From an edit to the question. */
const pauseMs = 80;
/** A forecast that takes longer would hold up the preview that the same edit calls for. */
const shortMs = 250;
let lastMs = 0;
let timer: ReturnType<typeof setTimeout> | undefined;
/** What the engine is asked at the moment. */
let asked: { surface: string; done: Promise<void> } | null = null;

const surfaceOf = (current: Recipe) => stageInput(current, 'smooth');
/** All that a forecast depends on: what the adapted surface does. */
const inputOf = (current: Recipe) => stageInput(current, 'remesh');

/** The forecast of the recipe's surface; `fresh` where it is also that of its sizes. */
export const forecast = computed<ForecastNow | null>(() => {
  const [current, last] = [recipe.value, answer.value];
  if (!current || !last || last.surface !== surfaceOf(current)) return null;
  const { numbers, problem } = last;
  const was = before.answer?.surface === last.surface ? before.answer.numbers : null;
  return { numbers, problem, was, fresh: last.input === inputOf(current) };
});

interface ForecastNow extends Pick<Answer, 'numbers' | 'problem'> {
  fresh: boolean;
  /** That of the recipe before its last step. */
  was: Forecast | null;
}

function take(found: Answer): void {
  if (stepCount.peek() !== before.steps) before = { steps: stepCount.peek(), answer: answer.peek() };
  answer.value = found;
}

/** Numbers of the forecast that are beyond the recipe's limits: the engine will refuse to mesh. */
export const exceeded = computed(() => {
  const [limits, numbers] = [recipe.value?.limits, forecast.value?.numbers];
  return limits && numbers ? exceededOf(numbers, limits) : [];
});

export interface Exceeded {
  field: keyof Recipe['limits'];
  found: number;
  limit: number;
}

export function exceededOf(numbers: Forecast, limits: Recipe['limits']): Exceeded[] {
  const all: Exceeded[] = [
    { field: 'tets', found: numbers.tets, limit: limits.tets },
    { field: 'memory_mb', found: numbers.peak_mb, limit: limits.memory_mb },
    { field: 'seconds', found: numbers.seconds, limit: limits.seconds },
  ];
  return all.filter(({ found, limit }) => limit > 0 && found > limit);
}

/** The label surface is there and the engine is free: a forecast takes no time from anything else. */
function mayAsk(current: Recipe): boolean {
  return (
    activity.value === 'idle' &&
    isMadeFrom(current, 'smooth') &&
    awaitedSides.value.length === 0 &&
    (!previewDue.value || lastMs < shortMs)
  );
}

/** Asks whenever the recipe calls for another forecast; one at a time, of the recipe as it then stands. */
export function keepForecast(): void {
  effect(() => {
    const current = recipe.value;
    if (!current || !mayAsk(current) || answer.value?.input === inputOf(current)) return;
    timer ??= setTimeout(() => {
      timer = undefined;
      ask();
    }, pauseMs);
  });
}

function ask(): void {
  const current = recipe.peek();
  if (!current || asked || !mayAsk(current)) return;
  const [surface, input] = [surfaceOf(current), inputOf(current)];
  const begin = performance.now();
  const done = engine.forecast(JSON.stringify(current), current.source).then(
    (numbers) => ({ surface, input, numbers, problem: '' }),
    (error: unknown) => {
      // Whatever has overtaken it calls for another when it is done.
      if (error instanceof EngineError && error.code === 'cancelled') return null;
      const problem = error instanceof Error ? error.message : String(error);
      return { surface, input, numbers: null, problem };
    },
  );
  asked = {
    surface,
    done: done.then((found) => {
      asked = null;
      lastMs = performance.now() - begin;
      if (found) take(found);
    }),
  };
}

/** The end of the forecast under way, and the surface that it is made from. */
export function forecastUnderWay(): Readonly<typeof asked> {
  return asked;
}

/** The sizes that give so many tetrahedra: the recipe's, all times one factor. `signal` ends the search. */
export async function fitSizes(elements: number, signal: AbortSignal): Promise<FittingSizes> {
  const current = recipe.peek();
  if (!current) throw new Error('There is no case yet.');
  const { fitting } = await engine.forecast(JSON.stringify(current), current.source, elements, signal);
  if (!fitting) throw new Error('The engine gave no sizes.');
  return { ...fitting, sizing: rounded(current.sizing, fitting.sizing) };
}

export function useSizes(fitting: FittingSizes, elements: number): void {
  editRecipe(`Sizes for ${elements.toLocaleString('en')} tetrahedra`, (draft) => {
    draft.sizing = fitting.sizing;
  });
}

/** `after` with four digits of every number that differs from `before`'s, which has the same shape. */
export function rounded<T>(before: T, after: T): T {
  if (typeof after === 'number') return (after === before ? after : Number(after.toPrecision(4))) as T;
  if (typeof after !== 'object' || after === null) return after;
  const entries = Object.entries(after).map(([key, value]): [string, unknown] => [
    key,
    rounded((before as Record<string, unknown>)[key], value),
  ]);
  return (Array.isArray(after) ? entries.map(([, value]) => value) : Object.fromEntries(entries)) as T;
}
