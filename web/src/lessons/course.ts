/** The lesson that is open: where the pupil is in it, what was answered, and what each step sets in the app. */
import { computed, effect, signal, untracked } from '@preact/signals';
import { EngineError, stageNames } from '../engine/contract';
import { openExample } from '../store/case/open_case';
import { keepText, keptText } from '../store/case/keep/web_storage';
import {
  allowedControls,
  keepLessonOpen,
  lessonAsked,
  type LessonAsked,
} from '../store/case/keep/lesson_asked';
import { announcement } from '../store/notices';
import { engine } from '../store/run/engine';
import { shownKeys } from '../store/run/results';
import { activity } from '../store/run/stages';
import { chooseLayout, colourBy, cut, showEdges, sliceOverlay, stageShown } from '../store/view';
import { pinned, unpin } from '../store/run/compare';
import { allHold, decidable, isNumberRight, isRight, numbersTyped } from './checks';
import type { Lesson, Step, StepView } from './lesson';
import { decodeLesson } from './lesson_link';
import { LessonError, parseLesson, readLesson } from './read_lesson';
import { shipped } from './shipped';

export interface Feedback {
  tone: 'right' | 'wrong' | 'unknown';
  text: string;
}

export const lesson = signal<Lesson | null>(null);
/** Why the lesson that was asked for cannot be opened. */
export const trouble = signal('');
/** Of a step; -1 before the first, and as many as there are after the last. */
export const at = signal(-1);
/** Steps whose question has been answered. */
export const solved = signal<ReadonlySet<number>>(new Set());
export const hintsShown = signal(0);
export const feedback = signal<Feedback | null>(null);
/** Cases on their way: what is there still belongs to the step before. */
const opening = signal(0);
export const caseComes = computed(() => opening.value > 0);
/** The farthest step so far: its case and those before it have been opened. */
let reached = -1;

export const step = computed((): Step | null => lesson.value?.steps[at.value] ?? null);
export const questionCount = computed(
  () => lesson.value?.steps.filter(({ question }) => question !== undefined).length ?? 0,
);

const progressKey = 'voxtet-lessons';
const mostKept = 30;

interface Progress {
  at: number;
  reached: number;
  solved: number[];
}

/** A lesson is known again by its title and its length. */
const keyOf = ({ title, steps }: Lesson): string => `${title} (${steps.length})`;

function allProgress(): Record<string, Progress> {
  try {
    return JSON.parse(keptText('localStorage', progressKey) ?? '{}') as Record<string, Progress>;
  } catch {
    return {};
  }
}

function saveProgress(): void {
  if (!lesson.value || lessonAsked.value?.from === 'editor') return;
  const mine = keyOf(lesson.value);
  const others = Object.entries(allProgress()).filter(([key]) => key !== mine);
  const all = [...others, [mine, { at: at.value, reached, solved: [...solved.value] }]].slice(-mostKept);
  keepText('localStorage', progressKey, JSON.stringify(Object.fromEntries(all)));
}

/** How far this pupil has come before; null where not beyond the first step. */
export function progressOf(of: Lesson): Progress | null {
  const found = allProgress()[keyOf(of)];
  return found && found.at > 0 && found.at < of.steps.length ? found : null;
}

async function fetchLesson(asked: LessonAsked): Promise<Lesson> {
  switch (asked.from) {
    case 'page': {
      const found = shipped.find(({ name }) => name === asked.name);
      if (!found) throw new LessonError(`This page has no lesson "${asked.name.slice(0, 40)}".`);
      return readLesson(await found.load());
    }
    case 'link':
      return decodeLesson(asked.fragment);
    case 'file':
      return parseLesson(asked.text);
    case 'editor':
      throw new LessonError('The lesson is still being written.');
  }
}

/** The engine knows the fields of a case. */
async function checkCases({ steps }: Lesson): Promise<void> {
  for (const [index, { case: recipe }] of steps.entries()) {
    if (!recipe) continue;
    try {
      await engine.checkRecipe(recipe);
    } catch (error) {
      if (error instanceof EngineError && error.code !== 'cancelled')
        throw new LessonError(`Step ${index + 1}, case: ${error.message}.`);
    }
  }
}

/** Reads the lesson that is asked for and shows what it is; nothing of it is opened. */
export async function openLesson(asked: LessonAsked): Promise<void> {
  endTrial();
  trouble.value = '';
  at.value = -1;
  try {
    const found = await fetchLesson(asked);
    await checkCases(found);
    if (lessonAsked.value !== asked) return;
    begin(found);
    const progress = progressOf(found);
    if (progress && asked.started) goOn(progress, false);
  } catch (error) {
    if (lessonAsked.value === asked) trouble.value = (error as Error).message;
  }
}

/** Holds a lesson at its beginning. */
export function begin(next: Lesson): void {
  lesson.value = next;
  solved.value = new Set();
  reached = -1;
  place(-1);
}

export function start(): void {
  goTo(0);
}

/** Goes on where the pupil was; with the case of that step, unless the page still has it. */
export function goOn(progress: Progress, withCase = true): void {
  solved.value = new Set(progress.solved);
  reached = progress.reached;
  place(progress.at);
  keepOpen();
  if (withCase) reopenCase();
}

function keepOpen(): void {
  const asked = lessonAsked.value;
  if (asked && asked.from !== 'editor') keepLessonOpen({ ...asked, started: true });
}

function place(next: number): void {
  at.value = next;
  hintsShown.value = 0;
  feedback.value = null;
  const { allow } = step.value ?? {};
  allowedControls.value = allow ? new Set(allow) : null;
}

/** Goes to a step. One that is new opens its case and sets the view; the others leave the app as it is. */
export function goTo(next: number): void {
  place(next);
  const fresh = lesson.value?.steps.slice(reached + 1, next + 1) ?? [];
  reached = Math.max(reached, next);
  keepOpen();
  saveProgress();
  if (!step.value || fresh.length === 0) return;
  if (fresh.some(({ case: recipe }) => recipe !== undefined)) {
    // A run of another case is not what the lesson means by the pinned one.
    unpin();
    reopenCase();
  } else setView(step.value.view);
}

/** The case that belongs to the step, as it was at first. */
export function reopenCase(): void {
  const steps = lesson.value?.steps.slice(0, at.value + 1) ?? [];
  const found = steps.findLast(({ case: recipe }) => recipe !== undefined)?.case;
  if (!found) return;
  opening.value++;
  void openExample({ recipe: found }).then(() => {
    opening.value--;
    setView(step.value?.view);
  });
}

let waiting: (() => void) | undefined;

/** At once where that is possible, and the stage as soon as it has a result. */
function setView(view: StepView | undefined): void {
  waiting?.();
  waiting = undefined;
  if (!view) return;
  if (view.layout && (view.layout !== 'compare' || pinned.value)) chooseLayout(view.layout);
  if (view.slices) sliceOverlay.value = view.slices;
  if (view.edges !== undefined) showEdges.value = view.edges;
  if (view.cut !== undefined) cut.value = { ...cut.value, on: view.cut };
  const stage = stageNames.find((name) => name === view.stage);
  waiting = effect(() => {
    if (activity.value !== 'idle' || (stage && shownKeys.value[stage] === undefined)) return;
    untracked(() => {
      if (stage) stageShown.value = stage;
      if (view.colour) colourBy.value = view.colour;
      // Of itself, once it has run.
      queueMicrotask(() => waiting?.());
    });
  });
}

/** Back to writing, from a lesson that was tried. */
export function endTrial(): void {
  waiting?.();
  allowedControls.value = null;
  lesson.value = null;
}

export function leave(): void {
  endTrial();
  keepLessonOpen(null);
  lessonAsked.value = null;
  const address = new URL(location.href);
  address.searchParams.delete('lesson');
  if (address.hash.startsWith('#l1=')) address.hash = '';
  history.replaceState(history.state, '', address);
}

/** From whatever lesson is open to the editor. */
export function writeLesson(): void {
  leave();
  lessonAsked.value = { from: 'editor' };
}

function solve(text: string): void {
  solved.value = new Set([...solved.value, at.value]);
  feedback.value = { tone: 'right', text: text || 'Right.' };
  saveProgress();
}

const unknown: Feedback = { tone: 'unknown', text: 'The app cannot tell yet: run first.' };

export function answerChoice(index: number): void {
  const { question, right, wrong } = step.value ?? {};
  if (question?.kind !== 'choice') return;
  if (!decidable(question)) return void (feedback.value = unknown);
  const option = question.options[index];
  const words = (rest: string | undefined) => [option.say, rest].filter(Boolean).join(' ');
  if (isRight(option)) solve(words(right));
  else feedback.value = { tone: 'wrong', text: words(wrong) || 'Not this one. Try again.' };
}

export function answerNumber(typed: string): void {
  const { question, right, wrong } = step.value ?? {};
  if (question?.kind !== 'number') return;
  const given = numbersTyped(typed);
  if (given.length === 0)
    return void (feedback.value = { tone: 'unknown', text: 'Expected a number, as 2.5 or 1e3.' });
  const verdicts = given.map((number) => isNumberRight(question, number));
  if (verdicts[0] === null) feedback.value = unknown;
  else if (verdicts.includes(true)) solve(right ?? '');
  else feedback.value = { tone: 'wrong', text: wrong || 'Not this number. Try again.' };
}

/** What is to be done in the app is done as soon as its checks hold. */
effect(() => {
  const { question, right } = step.value ?? {};
  if (question?.kind !== 'do' || solved.value.has(at.value)) return;
  if (caseComes.value || activity.value !== 'idle') return;
  if (!allHold(question.checks)) return;
  untracked(() => {
    solve(right ?? 'Done.');
    announcement.value = 'Done';
  });
});
