/** The mesh that is shown, and what a link promises of it. */
import { computed, signal } from '@preact/signals';
import type { Expected, Recipe, Report, SliceAlignment } from '../../engine/contract';
import { verdictOf } from '../../link/verdict';
import { recipe } from '../case/recipe';
import { forgetFound, forgetFrames } from './frames';
import { sameMesh } from './stage_inputs';

export interface Expectation {
  expected: Expected;
  recipe: Recipe;
}

export const report = signal<Report | null>(null);
/** The recipe of the mesh that is shown, and only its fields that differ from the defaults. */
export const meshedRecipe = signal<Recipe | null>(null);
export const meshedMinimal = signal<Record<string, unknown> | null>(null);
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
  return verdictOf(promise.expected, report.value);
});

/** What was done to the slices of a stack; null where none was moved. */
export const alignment = computed(
  () =>
    (report.value?.stages.find(({ name }) => name === 'volume')?.counts.alignment as
      | SliceAlignment
      | undefined) ?? null,
);

/** The mesh that is shown is another one than the report's. */
export function forgetReport(): void {
  report.value = null;
  meshedRecipe.value = null;
  meshedMinimal.value = null;
  forgetFrames();
  forgetFound();
}
