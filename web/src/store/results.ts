import { signal } from '@preact/signals';
import type { StageArrays, StageName } from '../engine/contract';

/**
 * Large arrays, keyed by stage and result digest. They stand outside the store: signals hold digests only.
 * Two results a stage are kept, so that undoing an edit shows its surface at once.
 */
const kept = new Map<string, Partial<StageArrays[StageName]>>();
const keptPerStage = 2;

/** Digest of the result that each stage shows, or nothing. */
export const shownDigests = signal<Partial<Record<StageName, string>>>({});

export function keepResult(stage: StageName, digest: string, arrays: Partial<StageArrays[StageName]>): void {
  const key = `${stage}:${digest}`;
  kept.delete(key);
  kept.set(key, arrays);
  const ofStage = [...kept.keys()].filter((name) => name.startsWith(`${stage}:`));
  for (const old of ofStage.slice(0, -keptPerStage)) kept.delete(old);
}

export function isKept(stage: StageName, digest: string): boolean {
  return kept.has(`${stage}:${digest}`);
}

export function showResult(stage: StageName, digest: string): void {
  shownDigests.value = { ...shownDigests.value, [stage]: digest };
}

/** The arrays that a stage shows now, complete or not at all. Reading subscribes to the digest. */
export function shownResult<S extends StageName>(stage: S): StageArrays[S] | undefined {
  const digest = shownDigests.value[stage];
  return digest === undefined ? undefined : (kept.get(`${stage}:${digest}`) as StageArrays[S] | undefined);
}

/** Stops showing the results of these stages. */
export function dropResults(stages: readonly StageName[]): void {
  const next = { ...shownDigests.value };
  for (const stage of stages) delete next[stage];
  shownDigests.value = next;
}

/** The points of whatever a stage shows, for the extent of the view. */
export function pointsOf(stage: StageName): Float32Array | undefined {
  const own = stage === 'quality' ? 'optimise' : stage;
  if (own === 'surface' || own === 'smooth' || own === 'remesh' || own === 'optimise')
    return shownResult(own)?.points;
  return shownResult('surface')?.points;
}
