/** A lesson on paper: its steps, its questions with room for answers, its link. */
import { useEffect, useState } from 'preact/hooks';
import { expectedNumber, isRight, titleOf, wordsOf } from '../../lessons/checks';
import { lesson } from '../../lessons/course';
import { finished } from '../../lessons/draft';
import type { Lesson, Question } from '../../lessons/lesson';
import { lessonAddress } from '../../lessons/lesson_link';
import { lessonAsked } from '../../store/case/keep/lesson_asked';
import { Dialog } from '../controls/dialog';
import { CheckField } from '../controls/fields';
import { short } from '../controls/format';
import { LessonText } from './lesson_text';

/** A link longer than this helps nobody on paper. */
const mostPrinted = 300;

/** What to look up, where the app alone knows the answer. */
function solutionOf(question: Question): string {
  switch (question.kind) {
    case 'choice':
      return '';
    case 'number': {
      const { answer, unit = '', within, percent } = question;
      const allowed = percent === undefined ? `± ${within} ${unit}` : `± ${percent} %`;
      const now = expectedNumber(question);
      if (typeof answer === 'number') return `${short(answer)} ${unit} (${allowed})`;
      return `${titleOf(answer)}${now === null ? '' : `, now ${short(now)} ${unit}`} (${allowed})`;
    }
    case 'do':
      return `${question.checks.map(wordsOf).join('; ')}.`;
  }
}

function SheetQuestion({ question, solutions }: { question: Question; solutions: boolean }) {
  return (
    <>
      <p class="sheet-question">{question.text}</p>
      {question.kind === 'choice' ? (
        <ul class="sheet-boxes">
          {question.options.map((option) => (
            <li key={option.text} class={solutions && isRight(option) ? 'solution' : undefined}>
              {option.text}
              {solutions && option.when && <em> (right if {option.when.map(wordsOf).join(' and ')})</em>}
            </li>
          ))}
        </ul>
      ) : (
        solutions && <p class="sheet-solution">{solutionOf(question)}</p>
      )}
      {!solutions && <div class="sheet-line" />}
      {!solutions && question.kind !== 'choice' && <div class="sheet-line" />}
    </>
  );
}

function Sheet({ of, solutions }: { of: Lesson; solutions: boolean }) {
  const [address, setAddress] = useState('');
  const asked = lessonAsked.value;
  useEffect(() => {
    let newest = true;
    void lessonAddress(of, asked?.from === 'page' ? asked.name : null).then(
      (found) => newest && setAddress(found),
    );
    return () => {
      newest = false;
    };
  }, [of, asked]);
  return (
    <article class="sheet" lang={of.language} data-testid="sheet" tabIndex={0} aria-label="Sheet">
      {!solutions && (
        <p class="sheet-name">
          Name <span /> Date <span />
        </p>
      )}
      <h1>{of.title}</h1>
      <LessonText text={of.summary} />
      {address.length <= mostPrinted ? (
        <p class="sheet-link">{address}</p>
      ) : (
        <p class="sheet-link">Opened by the link that came with this sheet.</p>
      )}
      {of.steps.map((step, i) => (
        <section key={i}>
          <h2>
            {i + 1}. {step.title}
          </h2>
          <LessonText text={step.text} />
          {step.question && <SheetQuestion question={step.question} solutions={solutions} />}
        </section>
      ))}
    </article>
  );
}

export function SheetDialog({ close }: { close(): void }) {
  const [solutions, setSolutions] = useState(false);
  const [of] = useState(() => lesson.value ?? finished());
  return (
    <Dialog title="Sheet to print" onClose={close}>
      <Sheet of={of} solutions={solutions} />
      <CheckField
        label="With the solutions"
        hint="The teacher’s copy"
        checked={solutions}
        onChange={setSolutions}
      />
      <div class="dialog-actions">
        <button type="button" class="button primary" onClick={() => window.print()}>
          Print
        </button>
      </div>
    </Dialog>
  );
}
