import { computed, signal } from '@preact/signals';
import {
  stageNames,
  type EngineError,
  type Expected,
  type Recipe,
  type Report,
  type Schema,
  type StageName,
  type StageSummary,
} from '../engine/contract';
import { verdictOf } from '../link/verdict';
import { recipe } from './recipe';
import { dropResults } from './results';
import { sameRecipe, stageInput } from './stage_inputs';
import { showPlace } from './view';

export type StageState = 'waiting' | 'running' | 'done' | 'stale' | 'failed';

export interface StageStatus {
  state: StageState;
  fraction: number;
  summary: StageSummary | null;
  /** What of the recipe the result was made from. */
  madeFrom: string | null;
}

export interface Expectation {
  expected: Expected;
  recipe: Recipe;
}

export type Activity = 'idle' | 'starting' | 'opening' | 'preview' | 'run' | 'export';

/** A sentence for the user: a failure to act on, or news. */
export interface Notice {
  id: number;
  tone: 'error' | 'news';
  title: string;
  text: string;
  /** What can be done about it. */
  way?: Way;
}

export interface Way {
  name: string;
  go(): void;
}

export const schema = signal<Schema | null>(null);
export const defaults = signal<Recipe | null>(null);
export const activity = signal<Activity>('starting');
/** A preview begins as soon as the user pauses. */
export const previewDue = signal(false);
export const stages = signal<Record<StageName, StageStatus>>(blankStages());
export const report = signal<Report | null>(null);
/** The recipe of the mesh that is shown, and only its fields that differ from the defaults. */
export const meshedRecipe = signal<Recipe | null>(null);
export const meshedMinimal = signal<Record<string, unknown> | null>(null);
/** What the opened link promises, and the recipe that it promises it for. */
export const expectation = signal<Expectation | null>(null);
export const notices = signal<Notice[]>([]);
export const announcement = signal('');
/** Milliseconds from Cancel to an engine that answers. */
export const lastCancelMs = signal<number | null>(null);
export const elapsedSeconds = signal(0);

/** Whether the mesh that is shown is the one that the recipe asks for. */
export const upToDate = computed(
  () => meshedRecipe.value !== null && sameRecipe(meshedRecipe.value, recipe.value),
);

/** Stages whose result is not what the recipe as it stands would give. */
export const staleStages = computed<ReadonlySet<StageName>>(() => {
  const current = recipe.value;
  if (!current) return new Set();
  return new Set(
    stageNames.filter((name) => {
      const { state, madeFrom } = stages.value[name];
      return state === 'stale' || (state === 'done' && madeFrom !== stageInput(current, name));
    }),
  );
});

/** Whether a stage has given what a recipe asks of it. */
export function isMadeFrom(current: Recipe, name: StageName): boolean {
  const { state, madeFrom } = stages.value[name];
  return state === 'done' && madeFrom === stageInput(current, name);
}

export const verdict = computed(() => {
  const promise = expectation.value;
  if (!promise || !report.value || !meshedRecipe.value) return null;
  if (!sameRecipe(promise.recipe, meshedRecipe.value)) return null;
  return verdictOf(promise.expected, report.value);
});

export function blankStages(): Record<StageName, StageStatus> {
  const blank = {} as Record<StageName, StageStatus>;
  for (const name of stageNames)
    blank[name] = { state: 'waiting', fraction: 0, summary: null, madeFrom: null };
  return blank;
}

export function setStage(name: StageName, change: Partial<StageStatus>): void {
  stages.value = { ...stages.value, [name]: { ...stages.value[name], ...change } };
}

export function forgetResults(): void {
  stages.value = blankStages();
  forgetReport();
  dropResults(stageNames);
}

/** The mesh that is shown is another one than the report's. */
export function forgetReport(): void {
  report.value = null;
  meshedRecipe.value = null;
  meshedMinimal.value = null;
}

/** Stages that were under way are no longer, and the clock stands still. */
export function endStages(): void {
  for (const name of stageNames) {
    const { state, summary, madeFrom } = stages.value[name];
    if (state !== 'running' && state !== 'waiting') continue;
    const kept = recipe.value && madeFrom === stageInput(recipe.value, name) ? 'done' : 'stale';
    setStage(name, { state: summary ? kept : 'waiting', fraction: 0 });
  }
  stopClock();
}

let clock: ReturnType<typeof setInterval> | undefined;

export function startClock(): void {
  const begin = performance.now();
  elapsedSeconds.value = 0;
  stopClock();
  clock = setInterval(() => (elapsedSeconds.value = (performance.now() - begin) / 1000), 100);
}

export function stopClock(): void {
  clearInterval(clock);
}

let noticeCount = 0;

export function tell(tone: Notice['tone'], title: string, text: string, way?: Way): void {
  const notice = { id: ++noticeCount, tone, title, text, way };
  const kept = notices.value.filter((old) => old.title !== title || old.text !== text);
  notices.value = [...kept, notice].slice(-4);
  if (tone === 'news') setTimeout(() => dismiss(notice.id), 6000);
}

export function dismiss(id: number): void {
  notices.value = notices.value.filter((notice) => notice.id !== id);
}

const errorTitles: Record<EngineError['code'], string> = {
  usage: 'These settings cannot be used',
  bad_input: 'This file cannot be read',
  meshing: 'Meshing did not succeed',
  differs: 'This is not the expected file',
  out_of_memory: 'Out of memory',
  cancelled: 'Cancelled',
  internal: 'The engine stopped',
};

export function tellFailure(error: EngineError): void {
  const { where } = error;
  const hasPlace = where.points.length > 0;
  const way = hasPlace ? { name: 'Show where', go: () => showPlace(where) } : undefined;
  tell('error', errorTitles[error.code], error.message, way);
  if (hasPlace) showPlace(where);
}
