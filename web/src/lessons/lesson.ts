/**
 * A lesson: steps that a pupil takes in the app itself. Plain JSON, so that a teacher can write it by hand, send it as a
 * file or put it into a link. `read_lesson.ts` says what is accepted.
 */
import type { ControlName } from '../store/case/keep/lesson_asked';
import type { Layout, SliceOverlay } from '../store/view';

export interface Lesson {
  version: 1;
  title: string;
  /** BCP 47, as "en". */
  language: string;
  /** What a pupil will know at the end. */
  summary: string;
  author?: string;
  minutes?: number;
  steps: Step[];
}

/** One screen of text. A step has at most one question, and is taken when that is answered. */
export interface Step {
  title: string;
  /** Paragraphs, lists ("- "), *emphasis* and `code`. */
  text: string;
  picture?: Picture;
  /** The recipe of a case that opens with the step. Without one the case of the step before stays. */
  case?: Record<string, unknown>;
  view?: StepView;
  /** What may be used; all, if absent. */
  allow?: ControlName[];
  /** Values that are shown beside the text. */
  show?: ValueRef[];
  question?: Question;
  hints?: string[];
  /** What is said to a right answer, and to a wrong one. */
  right?: string;
  wrong?: string;
}

export interface Picture {
  /** A data: URL of an image, or the name of a file beside the page. */
  source: string;
  /** For whoever does not see it. */
  alt: string;
}

export interface StepView {
  layout?: Layout;
  slices?: SliceOverlay;
  colour?: string;
  cut?: boolean;
  edges?: boolean;
  /** Shown as soon as it has a result. */
  stage?: string;
}

/** A value of the app, by a name of `values.ts`. */
export interface ValueRef {
  value: string;
  /** For values of one label. */
  label?: number;
  /** Over that of the pinned run. */
  per?: 'pinned';
}

/** What is asked of a value. The bounds count as within. */
export interface Check extends ValueRef {
  min?: number;
  max?: number;
  equal?: number | string;
}

export interface Option {
  text: string;
  /** Right, or right while all of `when` holds in the app. */
  right?: boolean;
  when?: Check[];
  /** What is said to whoever chose it. */
  say?: string;
}

export interface ChoiceQuestion {
  kind: 'choice';
  text: string;
  options: Option[];
}

export interface NumberQuestion {
  kind: 'number';
  text: string;
  unit?: string;
  /** A number, or where the app has it. */
  answer: number | ValueRef;
  /** What the app's value is multiplied by. */
  times?: number;
  /** How far off is still right: in the unit, or in percent of the answer. */
  within?: number;
  percent?: number;
}

/** Something to be done in the app: done as soon as all checks hold. */
export interface DoQuestion {
  kind: 'do';
  text: string;
  checks: Check[];
}

export type Question = ChoiceQuestion | NumberQuestion | DoQuestion;

export const blankStep = (): Step => ({ title: '', text: '' });
export const blankLesson = (): Lesson => ({
  version: 1,
  title: '',
  language: 'en',
  summary: '',
  steps: [blankStep()],
});
