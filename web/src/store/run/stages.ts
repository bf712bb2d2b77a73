/** The stages as they stand: what each has given, what it was made from, and what the engine is at. */
import { computed, signal } from '@preact/signals';
import {
  stageNames,
  stagesOfMesh,
  type Recipe,
  type Schema,
  type StageName,
  type StageSummary,
} from '../../engine/contract';
import { meshIsGiven } from '../case/input';
import { recipe } from '../case/recipe';
import { stopClock } from './clock';
import { forgetReport } from './report';
import { dropResults } from './results';
import { stageInput } from './stage_inputs';

export type StageState = 'waiting' | 'running' | 'done' | 'stale' | 'failed';

export interface StageStatus {
  state: StageState;
  fraction: number;
  summary: StageSummary | null;
  /** What of the recipe the result was made from. */
  madeFrom: string | null;
}

export type Activity = 'idle' | 'starting' | 'opening' | 'preview' | 'run' | 'export';

export const schema = signal<Schema | null>(null);
export const defaults = signal<Recipe | null>(null);
export const activity = signal<Activity>('starting');
/** A preview begins as soon as the user pauses. */
export const previewDue = signal(false);
export const stages = signal<Record<StageName, StageStatus>>(blankStages());
/** Milliseconds from Cancel to an engine that answers. */
export const lastCancelMs = signal<number | null>(null);

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

/** The stages that the case has. */
export const caseStages = computed(() => (meshIsGiven.value ? stagesOfMesh : stageNames));

/** Whether a stage has given what a recipe asks of it. */
export function isMadeFrom(current: Recipe, name: StageName): boolean {
  const { state, madeFrom } = stages.value[name];
  return state === 'done' && madeFrom === stageInput(current, name);
}

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
