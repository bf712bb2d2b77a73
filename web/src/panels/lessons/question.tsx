import { useState } from 'preact/hooks';
import { answerChoice, answerNumber, at, feedback, solved } from '../../lessons/course';
import type { ChoiceQuestion, NumberQuestion, Question } from '../../lessons/lesson';
import { Icon } from '../controls/icons';

function Choice({ question, done }: { question: ChoiceQuestion; done: boolean }) {
  const [chosen, setChosen] = useState<number | null>(null);
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        if (chosen !== null) answerChoice(chosen);
      }}
    >
      <fieldset>
        <legend>{question.text}</legend>
        {question.options.map((option, i) => (
          <label key={i} class="lesson-option">
            <input
              type="radio"
              name="answer"
              disabled={done}
              checked={chosen === i}
              onChange={() => {
                setChosen(i);
                feedback.value = null;
              }}
            />
            <span>{option.text}</span>
          </label>
        ))}
      </fieldset>
      {!done && (
        <button type="submit" class="button" disabled={chosen === null}>
          Check
        </button>
      )}
    </form>
  );
}

function NumberAnswer({ question, done }: { question: NumberQuestion; done: boolean }) {
  const [typed, setTyped] = useState('');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        answerNumber(typed);
      }}
    >
      <label class="lesson-number">
        <span>{question.text}</span>
        <span class="field-input">
          <input
            type="text"
            inputMode="decimal"
            autocomplete="off"
            aria-label="Answer"
            value={typed}
            disabled={done}
            onInput={(event) => {
              setTyped(event.currentTarget.value);
              feedback.value = null;
            }}
          />
          {question.unit && <span class="unit">{question.unit}</span>}
        </span>
      </label>
      {!done && (
        <button type="submit" class="button" disabled={typed.trim() === ''}>
          Check
        </button>
      )}
    </form>
  );
}

/** The one question of a step, and what is said to the answer. */
export function StepQuestion({ question }: { question: Question }) {
  const done = solved.value.has(at.value);
  const said = feedback.value;
  return (
    <div class={done ? 'lesson-question done' : 'lesson-question'} data-testid="question" data-done={done}>
      {question.kind === 'choice' && <Choice question={question} done={done} />}
      {question.kind === 'number' && <NumberAnswer question={question} done={done} />}
      {question.kind === 'do' && (
        <p class="lesson-do">
          <Icon name={done ? 'check' : 'target'} size={15} /> <span>{question.text}</span>
        </p>
      )}
      <p class={`lesson-feedback ${said?.tone ?? (done ? 'right' : '')}`} role="status">
        {said?.text ?? (done ? 'Answered.' : '')}
      </p>
    </div>
  );
}
