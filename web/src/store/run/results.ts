import { signal } from '@preact/signals';
import type { StageArrays, StageName } from '../../engine/contract';

/**
 * Large arrays, by stage and key of the result. They stand outside the store: signals hold keys only.
 * Two results a stage are kept, so that undoing an edit shows its surface at once.
 */
const kept = new Map<string, Partial<StageArrays[StageName]>>();
const keptPerStage = 2;

/** Key of the result that each stage shows, or nothing. */
export const shownKeys = signal<Partial<Record<StageName, string>>>({});

export function keepResult(stage: StageName, key: string, arrays: Partial<StageArrays[StageName]>): void {
  const name = `${stage}:${key}`;
  kept.delete(name);
  kept.set(name, arrays);
  const ofStage = [...kept.keys()].filter((name) => name.startsWith(`${stage}:`));
  for (const old of ofStage.slice(0, -keptPerStage)) kept.delete(old);
}

export function isKept(stage: StageName, key: string): boolean {
  return kept.has(`${stage}:${key}`);
}

export function showResult(stage: StageName, key: string): void {
  shownKeys.value = { ...shownKeys.value, [stage]: key };
}

/** The arrays that a stage shows now, complete or not at all. Reading subscribes to the key. */
export function shownResult<S extends StageName>(stage: S): StageArrays[S] | undefined {
  const key = shownKeys.value[stage];
  return key === undefined ? undefined : (kept.get(`${stage}:${key}`) as StageArrays[S] | undefined);
}

/** Stops showing the results of these stages. */
export function dropResults(stages: readonly StageName[]): void {
  const next = { ...shownKeys.value };
  for (const stage of stages) delete next[stage];
  shownKeys.value = next;
}

/** The points of whatever a stage shows, for the extent of the view. */
export function pointsOf(stage: StageName): Float32Array | undefined {
  const own = stage === 'quality' ? 'optimise' : stage;
  if (own === 'surface' || own === 'smooth' || own === 'remesh' || own === 'optimise')
    return shownResult(own)?.points;
  return shownResult('surface')?.points;
}
