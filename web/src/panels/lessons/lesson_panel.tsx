/** The lesson beside the app: what it is, its steps one by one, its end. */
import { useEffect, useRef } from 'preact/hooks';
import {
  at,
  caseComes,
  endTrial,
  goOn,
  goTo,
  hintsShown,
  leave,
  lesson,
  openLesson,
  progressOf,
  questionCount,
  reopenCase,
  solved,
  start,
  step,
  trouble,
  writeLesson,
} from '../../lessons/course';
import type { Lesson, Step } from '../../lessons/lesson';
import { volume } from '../../store/case/input';
import { lessonAsked, type LessonAsked } from '../../store/case/keep/lesson_asked';
import { paintedEdges, paintedName } from '../../store/case/painting';
import { writeFiles } from '../controls/write_files';
import { dialogShown } from '../controls/dialog_shown';
import { fetched } from '../controls/fetched';
import { Icon } from '../controls/icons';
import { LessonText } from './lesson_text';
import { LiveValues } from './live_values';
import { StepQuestion } from './question';

const LessonEditor = fetched(() => import('./editor/lesson_editor').then((part) => part.LessonEditor));

async function editCopy(of: Lesson): Promise<void> {
  const { beginDraft } = await import('../../lessons/draft');
  beginDraft(of);
  writeLesson();
}

/** Takes the focus, so that whoever does not see the page hears what has come. */
function Heading({ text, of }: { text: string; of: unknown }) {
  const element = useRef<HTMLHeadingElement>(null);
  useEffect(() => element.current?.focus(), [of]);
  return (
    <h2 ref={element} tabIndex={-1}>
      {text}
    </h2>
  );
}

const count = (many: number, one: string) => `${many} ${one}${many === 1 ? '' : 's'}`;

function Intro({ of }: { of: Lesson }) {
  const progress = progressOf(of);
  const facts = [
    count(of.steps.length, 'step'),
    ...(of.minutes ? [`about ${of.minutes} minutes`] : []),
    ...(of.author ? [`by ${of.author}`] : []),
  ];
  const replaces = volume.value !== null && of.steps.some(({ case: own }) => own !== undefined);
  return (
    <>
      <Heading text={of.title} of={of} />
      <LessonText text={of.summary} />
      <p class="facts">{facts.join(', ')}.</p>
      {replaces && (
        <p class="facts">
          It opens a case of its own. The settings of yours stay a step back in the browser’s history; files
          are dropped in again.
          {paintedEdges().length > 0 && ' What you have painted is lost, unless you save it:'}
        </p>
      )}
      <div class="lesson-actions">
        {replaces && paintedEdges().length > 0 && (
          <button
            type="button"
            class="button"
            onClick={() => writeFiles(({ downloadPainted }) => downloadPainted())}
          >
            <Icon name="download" size={13} /> {paintedName}
          </button>
        )}
        <button type="button" class="button" onClick={() => (dialogShown.value = 'sheet')}>
          Sheet to print
        </button>
        {lessonAsked.value?.from !== 'editor' && (
          <button
            type="button"
            class="button"
            title="Write a lesson of yours from it"
            onClick={() => void editCopy(of)}
          >
            Edit a copy
          </button>
        )}
        {progress && (
          <button type="button" class="button" onClick={start}>
            From the beginning
          </button>
        )}
        <button type="button" class="button primary" onClick={() => (progress ? goOn(progress) : start())}>
          <Icon name="play" size={13} /> {progress ? `Go on at step ${progress.at + 1}` : 'Start'}
        </button>
      </div>
    </>
  );
}

function Hints({ hints }: { hints: readonly string[] }) {
  const shown = hints.slice(0, hintsShown.value);
  return (
    <div class="lesson-hints" role="region" aria-label="Hints" aria-live="polite">
      {shown.map((hint) => (
        <div key={hint} class="lesson-hint">
          <LessonText text={hint} />
        </div>
      ))}
    </div>
  );
}

function StepView({ of, now, index }: { of: Lesson; now: Step; index: number }) {
  const { question, hints = [] } = now;
  const done = !question || solved.value.has(index);
  const hasCase = of.steps.slice(0, index + 1).some(({ case: recipe }) => recipe !== undefined);
  const leftHints = hints.length - hintsShown.value;
  return (
    <>
      <Heading text={now.title} of={now} />
      <LessonText text={now.text} />
      {now.picture && <img class="lesson-picture" src={now.picture.source} alt={now.picture.alt} />}
      {question && <StepQuestion key={index} question={question} />}
      {now.show && <LiveValues refs={now.show} />}
      <Hints hints={hints} />
      <div class="lesson-actions">
        {hasCase && (
          <button
            type="button"
            class="button"
            title="Opens the case of this step again, as it was"
            onClick={reopenCase}
          >
            Reset
          </button>
        )}
        {!done && leftHints > 0 && (
          <button type="button" class="button" onClick={() => hintsShown.value++}>
            {hintsShown.value > 0 ? 'Another hint' : 'Hint'}
          </button>
        )}
        <span class="spacer" />
        <button type="button" class="button" onClick={() => goTo(index - 1)} disabled={index === 0}>
          Back
        </button>
        <button type="button" class={done ? 'button primary' : 'button'} onClick={() => goTo(index + 1)}>
          {done ? (index === of.steps.length - 1 ? 'Finish' : 'Next') : 'Skip'}
        </button>
      </div>
    </>
  );
}

function End({ of }: { of: Lesson }) {
  const all = questionCount.value;
  return (
    <>
      <Heading text="The end of the lesson" of={of} />
      <p data-testid="lesson-end">
        {of.title}: {all === 0 ? 'read to its end' : `${solved.value.size} of ${all} questions answered`}. The
        whole app is yours again; this case stays open.
      </p>
      <div class="lesson-actions">
        <button type="button" class="button" onClick={() => goTo(of.steps.length - 1)}>
          Back
        </button>
        <button type="button" class="button" onClick={() => (dialogShown.value = 'lessons')}>
          Other lessons
        </button>
        <button type="button" class="button primary" onClick={leave}>
          Leave the lesson
        </button>
      </div>
    </>
  );
}

function Steps({ of }: { of: Lesson }) {
  return (
    <ol class="lesson-steps" aria-label="Steps">
      {of.steps.map(({ title, question }, i) => {
        const done = question ? solved.value.has(i) : i < at.value;
        return (
          <li key={i}>
            <button
              type="button"
              class={done ? 'done' : ''}
              aria-current={i === at.value ? 'step' : undefined}
              aria-label={`Step ${i + 1}: ${title}${done ? ', done' : ''}`}
              title={`${i + 1}. ${title}`}
              onClick={() => goTo(i)}
            >
              {i + 1}
            </button>
          </li>
        );
      })}
    </ol>
  );
}

function Course({ of }: { of: Lesson }) {
  const index = at.value;
  const now = step.value;
  return (
    <>
      {index >= 0 && <Steps of={of} />}
      <div
        class="lesson-body lesson-step"
        aria-busy={caseComes.value}
        lang={of.language}
        data-testid="lesson-step"
        data-step={index + 1}
      >
        {now ? <StepView of={of} now={now} index={index} /> : index < 0 ? <Intro of={of} /> : <End of={of} />}
      </div>
    </>
  );
}

export function LessonPanel({ asked }: { asked: LessonAsked }) {
  useEffect(() => {
    if (asked.from !== 'editor') void openLesson(asked);
  }, [asked]);
  const of = lesson.value;
  const writes = asked.from === 'editor';
  return (
    <>
      <div class="lesson-head">
        <span class="lesson-name" title={of?.title}>
          {writes && !of ? 'Writing a lesson' : (of?.title ?? 'Lesson')}
        </span>
        {writes && of ? (
          <button type="button" class="button small" onClick={endTrial}>
            Back to writing
          </button>
        ) : (
          <button
            type="button"
            class="icon-button small"
            aria-label="Leave the lesson"
            title="Leave the lesson"
            onClick={leave}
          >
            <Icon name="cross" size={14} />
          </button>
        )}
      </div>
      {trouble.value && (
        <p class="stale lesson-body" role="alert">
          This lesson cannot be opened. {trouble.value}
        </p>
      )}
      {of ? <Course of={of} /> : writes ? <LessonEditor /> : null}
    </>
  );
}

/** What a link, a file or the list of lessons has asked for. */
export function AskedLesson() {
  return lessonAsked.value && <LessonPanel asked={lessonAsked.value} />;
}
