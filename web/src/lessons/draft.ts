/** The lesson that a teacher is writing: kept by the browser with every change, until it is begun anew. */
import { computed, effect, signal } from '@preact/signals';
import { recipe } from '../store/case/recipe';
import { keepText, keptText } from '../store/case/keep/web_storage';
import { tell } from '../store/notices';
import { engine } from '../store/run/engine';
import { colourBy, cut, layout, showEdges, sliceOverlay, stageShown } from '../store/view';
import { begin } from './course';
import { blankLesson, blankStep, type Lesson, type Step } from './lesson';
import { LessonError, maxLessonChars, maxPictureChars, readLesson } from './read_lesson';

const draftKey = 'voxtet-lesson-draft';

/** Of an earlier version, or damaged: what is there is shown, and what is wrong with it is said. */
function kept(): Lesson {
  try {
    const found = JSON.parse(keptText('localStorage', draftKey) ?? '') as Lesson;
    return Array.isArray(found.steps) && found.steps.length > 0 ? found : blankLesson();
  } catch {
    return blankLesson();
  }
}

export const draft = signal<Lesson>(kept());
/** The step that is being written. */
export const written = signal(0);

/** Whether the browser keeps the draft: one that is too long to hand out is too long to keep. */
export const draftKept = computed(() => JSON.stringify(draft.value).length <= maxLessonChars);

effect(() => {
  if (draftKept.value) keepText('localStorage', draftKey, JSON.stringify(draft.value));
});

export function editLesson(change: Partial<Lesson>): void {
  draft.value = { ...draft.value, ...change };
}

export function editStep(change: Partial<Step>): void {
  const steps = draft.value.steps.map((step, i) => (i === written.value ? { ...step, ...change } : step));
  editLesson({ steps });
}

export function addStep(): void {
  const { steps } = draft.value;
  editLesson({ steps: steps.toSpliced(written.value + 1, 0, blankStep()) });
  written.value++;
}

export function removeStep(): void {
  const steps = draft.value.steps.toSpliced(written.value, 1);
  written.value = Math.max(0, Math.min(written.value, steps.length - 1));
  editLesson({ steps: steps.length > 0 ? steps : [blankStep()] });
}

export function moveStep(by: 1 | -1): void {
  const { steps } = draft.value;
  const [from, to] = [written.value, written.value + by];
  if (to < 0 || to >= steps.length) return;
  editLesson({ steps: steps.toSpliced(from, 1).toSpliced(to, 0, steps[from]) });
  written.value = to;
}

/** Another lesson is written from now on; the one before can be had back. */
export function beginDraft(next = blankLesson()): void {
  const before = draft.value;
  written.value = 0;
  draft.value = next;
  if (JSON.stringify(before) === JSON.stringify(blankLesson())) return;
  tell('news', 'Another lesson is begun', `“${before.title || 'Untitled'}” is no longer kept.`, {
    name: 'Go back to it',
    go: () => {
      written.value = 0;
      draft.value = before;
    },
  });
}

/** The case that is open now comes with the step. */
export async function takeCase(): Promise<void> {
  if (!recipe.value) return;
  const { minimal } = await engine.checkRecipe(recipe.value);
  editStep({ case: minimal });
}

/** What the page shows now is what the step sets. */
export function takeView(): void {
  editStep({
    view: {
      layout: layout.value,
      ...(layout.value === 'slices' ? { slices: sliceOverlay.value } : {}),
      stage: stageShown.value,
      colour: colourBy.value,
      cut: cut.value.on,
      edges: showEdges.value,
    },
  });
}

/** Pictures are this wide at most, in pixels: a lesson is to fit into a link. */
const pictureWidth = 480;

export async function takePicture(blob: Blob): Promise<void> {
  const image = await createImageBitmap(blob);
  const scale = Math.min(1, pictureWidth / image.width);
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(scale * image.width);
  canvas.height = Math.round(scale * image.height);
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  const source = canvas.toDataURL('image/webp', 0.8);
  if (source.length > maxPictureChars) throw new Error('The picture is too large for a lesson.');
  const { alt = '' } = draft.value.steps[written.value].picture ?? {};
  editStep({ picture: { source, alt } });
}

/** Without fields that were left empty; a case stays as it is. */
function filled(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(filled);
  if (value === null || typeof value !== 'object') return value;
  const entries = Object.entries(value).filter(
    ([key, entry]) =>
      entry !== '' && !(Array.isArray(entry) && entry.length === 0 && (key === 'hints' || key === 'show')),
  );
  return Object.fromEntries(entries.map(([key, entry]) => [key, key === 'case' ? entry : filled(entry)]));
}

/** A lesson as the text of a file. */
export const fileTextOf = (of: Lesson): string => JSON.stringify(of, null, 2);

/** The lesson as it goes out. Throws LessonError, with what is missing or too much. */
export function finished(): Lesson {
  const found = readLesson(filled(draft.value));
  const { length } = fileTextOf(found);
  if (length > maxLessonChars)
    throw new LessonError(
      `The lesson has ${length.toLocaleString('en')} characters, at most ${maxLessonChars.toLocaleString('en')} can be opened: fewer or smaller pictures make it shorter.`,
    );
  return found;
}

/** Why the lesson cannot go out yet. */
export function draftFault(): string {
  try {
    finished();
    return '';
  } catch (error) {
    return (error as Error).message;
  }
}

/** Takes the lesson as a pupil would. */
export function tryLesson(): void {
  begin(finished());
}
