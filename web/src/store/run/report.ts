/** The mesh that is shown, and what a link promises of it. */
import { computed, signal } from '@preact/signals';
import type { Expected, Recipe, Report, SliceAlignment } from '../../engine/contract';
import { canonicalJson } from '../../link/canonical';
import { verdictOf } from '../../link/verdict';
import { recipe } from '../case/recipe';
import { forgetFound, forgetFrames, foundPhysics, simulationDigests, simulationReport } from './frames';
import { sameMesh } from './stage_inputs';

export interface Expectation {
  expected: Expected;
  recipe: Recipe;
}

export const report = signal<Report | null>(null);
/** The recipe of the mesh that is shown. */
export const meshedRecipe = signal<Recipe | null>(null);
/** What the opened link promises, and the recipe that it promises it for. */
export const expectation = signal<Expectation | null>(null);

/** Whether the mesh that is shown is the one that the recipe asks for. */
export const upToDate = computed(
  () => meshedRecipe.value !== null && sameMesh(meshedRecipe.value, recipe.value),
);

export const verdict = computed(() => {
  const promise = expectation.value;
  if (!promise || !report.value || !meshedRecipe.value) return null;
  if (!sameMesh(promise.recipe, meshedRecipe.value)) return null;
  const simulated = samePhysics(promise.recipe) ? simulationDigests.value : null;
  return verdictOf(promise.expected, {
    ...report.value,
    physics: undefined,
    stages: undefined,
    ...simulated,
  });
});

/** Whether what was simulated is what a recipe asks for. */
function samePhysics({ physics }: Recipe): boolean {
  const done = foundPhysics.value;
  return physics !== undefined && done !== null && canonicalJson(physics) === canonicalJson(done);
}

/** What a link of the recipe as it stands may promise: the mesh that is shown, and what was simulated on it. */
export function promiseOf(current: Recipe): Expected | undefined {
  const found = upToDate.value ? report.value : null;
  if (!found) return undefined;
  const { engine, digest, tets } = found;
  const simulated = samePhysics(current) ? simulationDigests.value : null;
  return { engine, digest, tets, ...(simulated as Pick<Expected, 'physics' | 'stages'> | null) };
}

/** What was done to the slices of a stack; null where none was moved. */
export const alignment = computed(
  () =>
    (report.value?.stages.find(({ name }) => name === 'volume')?.counts.alignment as
      | SliceAlignment
      | undefined) ?? null,
);

/** With what simulations of the mesh have found, where there were any. */
export const fullReport = computed(() => (report.value ? (simulationReport.value ?? report.value) : null));

/** The mesh that is shown is another one than the report's. */
export function forgetReport(): void {
  report.value = null;
  meshedRecipe.value = null;
  forgetFrames();
  forgetFound();
}
