import { computed, signal } from '@preact/signals';
import { applyPatches, enablePatches, produceWithPatches, type Patch } from 'immer';
import type { Recipe } from '../../engine/contract';

enablePatches();

/** The part of a step that stands outside the recipe: painted voxels. Done already when it is handed over. */
export interface Beside {
  undo(): void;
  redo(): void;
}

interface Step {
  label: string;
  key: string | undefined;
  time: number;
  patches: Patch[];
  inverse: Patch[];
  beside: Beside | undefined;
}

const past = signal<Step[]>([]);
const future = signal<Step[]>([]);
const maxSteps = 200;
/** Edits of one control in quick succession are one step. */
const joinMs = 900;

/** The recipe: the only truth about a case. Null until the engine has told its defaults. */
export const recipe = signal<Recipe | null>(null);
/** Steps that can be undone: one more after an edit, the same while a control is dragged. */
export const stepCount = computed(() => past.value.length);
export const undoLabel = computed(() => past.value.at(-1)?.label ?? null);
export const redoLabel = computed(() => future.value.at(-1)?.label ?? null);

/** What the files of a case are called, without their suffixes. */
export function caseName(): string {
  const source = recipe.value?.source;
  const name = source?.file?.name ?? source?.inline?.name ?? source?.phantom?.kind ?? 'mesh';
  return name.replace(/\.(nii\.gz|seg\.nrrd|[^.]+)$/i, '') || 'mesh';
}

/** Names the case that the recipe is of, in the browser's history and where the case is saved. */
export const caseId = signal('');

/** When the recipe last became another, in ms. Of two that are kept of a case, the later is the user's. */
export const changedAt = computed(() => (recipe.value ? Date.now() : 0));

/** Whether what is to be meshed is in the recipe itself. */
export const needsNoFile = ({ source }: Recipe): boolean =>
  source.phantom !== undefined || source.inline !== undefined;

/** Whether a recipe says what is to be meshed. */
export function hasSource(of: Recipe): boolean {
  return needsNoFile(of) || of.source.file !== undefined;
}

/** Replaces the recipe and forgets its history: another case begins, or that of this name is taken up again. */
export function startRecipe(next: Recipe, id = Math.random().toString(36).slice(2)): void {
  caseId.value = id;
  recipe.value = next;
  past.value = [];
  future.value = [];
}

function joined(first: Beside | undefined, then: Beside | undefined): Beside | undefined {
  if (!first || !then) return first ?? then;
  return {
    undo() {
      then.undo();
      first.undo();
    },
    redo() {
      first.redo();
      then.redo();
    },
  };
}

/**
 * Edits the recipe as one step of its history. Steps with the same `key` in quick succession are joined;
 * those of one drag however long it takes, with `patienceMs` infinite.
 */
export function editRecipe(
  label: string,
  change: (draft: Recipe) => void,
  key?: string,
  patienceMs = joinMs,
  beside?: Beside,
): void {
  if (!recipe.value) return;
  const [next, patches, inverse] = produceWithPatches(recipe.value, (draft) => void change(draft as Recipe));
  if (patches.length === 0 && !beside) return;
  const last = past.value.at(-1);
  const time = Date.now();
  if (last && key !== undefined && last.key === key && time - last.time < patienceMs) {
    const both = {
      ...last,
      time,
      patches: [...last.patches, ...patches],
      inverse: [...inverse, ...last.inverse],
      beside: joined(last.beside, beside),
    };
    past.value = [...past.value.slice(0, -1), both];
  } else {
    past.value = [...past.value, { label, key, time, patches, inverse, beside }].slice(-maxSteps);
  }
  future.value = [];
  recipe.value = next;
}

/** Changes the recipe without a step: for what the engine adds to it, such as a digest. */
export function amendRecipe(change: (draft: Recipe) => void): void {
  if (!recipe.value) return;
  recipe.value = produceWithPatches(recipe.value, (draft) => void change(draft as Recipe))[0];
}

export function undo(): void {
  const step = past.value.at(-1);
  if (!step || !recipe.value) return;
  step.beside?.undo();
  recipe.value = applyPatches(recipe.value, step.inverse);
  past.value = past.value.slice(0, -1);
  future.value = [...future.value, { ...step, key: undefined }];
}

export function redo(): void {
  const step = future.value.at(-1);
  if (!step || !recipe.value) return;
  step.beside?.redo();
  recipe.value = applyPatches(recipe.value, step.patches);
  future.value = future.value.slice(0, -1);
  past.value = [...past.value, step];
}
