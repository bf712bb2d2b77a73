import type { Recipe, StageName } from '../../engine/contract';
import { canonicalJson } from '../../link/canonical';

/** What each stage is made from: fields of the recipe, and stages before it. */
const inputs: Record<StageName, { fields: (keyof Recipe)[]; after: StageName[] }> = {
  volume: { fields: ['source', 'labels', 'merge', 'volume'], after: [] },
  surface: { fields: ['surface'], after: ['volume'] },
  smooth: { fields: ['smooth'], after: ['surface'] },
  sizing: { fields: ['sizing'], after: ['smooth'] },
  remesh: { fields: ['remesh'], after: ['sizing'] },
  optimise: { fields: ['tetra', 'optimise'], after: ['remesh'] },
  quality: { fields: ['lookup', 'quality'], after: ['optimise'] },
};

function fieldsOf(stage: StageName): Set<keyof Recipe> {
  const { fields, after } = inputs[stage];
  return new Set([...after.flatMap((before) => [...fieldsOf(before)]), ...fields]);
}

const reaching = Object.fromEntries(
  (Object.keys(inputs) as StageName[]).map((stage) => [stage, [...fieldsOf(stage)].sort()]),
) as Record<StageName, (keyof Recipe)[]>;

/** Everything of the recipe that a stage's result depends on: where it differs, the stage has to run again. */
export function stageInput(recipe: Recipe, stage: StageName): string {
  return canonicalJson(reaching[stage].map((field) => recipe[field]));
}

/** Whether two recipes ask for the same, in whatever order their fields stand. */
export function sameRecipe(one: Recipe | null, other: Recipe | null): boolean {
  return one === other || (one !== null && other !== null && canonicalJson(one) === canonicalJson(other));
}
