/** What the engine's jobs tell while they run, and answer. */
import type { Frame, Recipe, StageArrays, StageName, StageSummary } from './contract';

export interface RunHandlers {
  /** Calls the job off. */
  signal?: AbortSignal;
  onProgress?(stage: StageName, fraction: number): void;
  /** Whether the arrays of a stage that is done are to be copied out of the engine; else they are. */
  wants?(summary: StageSummary): boolean;
  /** A stage is done; nothing is handed over that was not wanted. The next stage waits where this gives a promise. */
  onStage?(summary: StageSummary, arrays: Partial<StageArrays[StageName]> | null): unknown;
}

export interface SimulationHandlers {
  signal?: AbortSignal;
  onProgress(stage: string, fraction: number): void;
  onFrame(frame: Frame): void;
}

export interface RecipeReply {
  recipe: Recipe;
  minimal: Record<string, unknown>;
}
