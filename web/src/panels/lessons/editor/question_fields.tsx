import { editStep } from '../../../lessons/draft';
import { unitOf } from '../../../lessons/checks';
import type { ChoiceQuestion, NumberQuestion, Option, Question } from '../../../lessons/lesson';
import { readValue } from '../../../lessons/values';
import { SelectField } from '../../controls/fields';
import { RemoveButton } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';
import { foundText } from '../live_values';
import { TextField } from './text_field';
import { ChecksFields, ValueFields } from './value_fields';

const kinds = [
  ['none', 'None: text alone'],
  ['choice', 'Choose one answer'],
  ['number', 'Enter a number'],
  ['do', 'Do something in the app'],
] as const;

const fresh: Record<Question['kind'], (text: string) => Question> = {
  choice: (text) => ({ kind: 'choice', text, options: [{ text: '', right: true }, { text: '' }] }),
  number: (text) => ({ kind: 'number', text, answer: { value: 'mesh.tets' }, percent: 5 }),
  do: (text) => ({ kind: 'do', text, checks: [{ value: 'run.done', equal: 1 }] }),
};

function OptionFields(props: {
  name: string;
  option: Option;
  onChange(next: Option): void;
  onRemove(): void;
}) {
  const { name, option, onChange } = props;
  const { when, right } = option;
  const set = (change: Partial<Option>) => onChange({ ...option, ...change });
  return (
    <div class="edit-check" role="group" aria-label={name}>
      <TextField label={name} value={option.text} onChange={(text) => set({ text })} />
      <div class="edit-bounds">
        <select
          aria-label={`${name} is`}
          value={when ? 'when' : right ? 'right' : 'wrong'}
          onChange={(event) => {
            const next = event.currentTarget.value;
            set({
              right: next === 'right' ? true : undefined,
              when: next === 'when' ? [{ value: 'run.done', equal: 1 }] : undefined,
            });
          }}
        >
          <option value="right">Right</option>
          <option value="wrong">Wrong</option>
          <option value="when">Right while checks hold</option>
        </select>
        <RemoveButton what={name.toLowerCase()} onRemove={props.onRemove} />
      </div>
      {when && <ChecksFields checks={when} onChange={(next) => set({ when: next })} />}
    </div>
  );
}

function ChoiceFields({ question, set }: { question: ChoiceQuestion; set(next: Question): void }) {
  const { options } = question;
  const change = (next: Option[]) => set({ ...question, options: next });
  return (
    <>
      {options.map((option, i) => (
        <OptionFields
          key={i}
          name={`Answer ${i + 1}`}
          option={option}
          onChange={(next) => change(options.with(i, next))}
          onRemove={() => change(options.toSpliced(i, 1))}
        />
      ))}
      <button type="button" class="button small" onClick={() => change([...options, { text: '' }])}>
        <Icon name="plus" size={13} /> Answer
      </button>
    </>
  );
}

function Tolerance({ question, set }: { question: NumberQuestion; set(next: Question): void }) {
  const { within, percent } = question;
  const inPercent = percent !== undefined;
  const tolerance = (amount: number, relative: boolean) =>
    set({ ...question, within: relative ? undefined : amount, percent: relative ? amount : undefined });
  return (
    <div class="edit-bounds">
      <label class="edit-inline">
        <span>Right within</span>
        <input
          type="number"
          min={0}
          step="any"
          aria-label="Right within"
          value={inPercent ? percent : within}
          onInput={(event) => tolerance(Number(event.currentTarget.value), inPercent)}
        />
      </label>
      <select
        aria-label="Tolerance in"
        value={inPercent ? 'percent' : 'unit'}
        onChange={(event) => tolerance(percent ?? within ?? 0, event.currentTarget.value === 'percent')}
      >
        <option value="percent">percent</option>
        <option value="unit">the unit</option>
      </select>
      <label class="edit-inline">
        <span>Unit</span>
        <input
          type="text"
          aria-label="Unit of the answer"
          maxLength={12}
          value={question.unit ?? ''}
          onInput={(event) => set({ ...question, unit: event.currentTarget.value })}
        />
      </label>
    </div>
  );
}

function NumberFields({ question, set }: { question: NumberQuestion; set(next: Question): void }) {
  const { answer } = question;
  const own = typeof answer === 'number';
  return (
    <>
      <SelectField
        label="The answer"
        value={own ? 'own' : 'app'}
        options={[
          ['app', 'as the app has it'],
          ['own', 'a number of mine'],
        ]}
        onChange={(next) => set({ ...question, answer: next === 'own' ? 0 : { value: 'mesh.tets' } })}
      />
      {own ? (
        <label class="edit-inline">
          <span>Number</span>
          <input
            type="number"
            step="any"
            aria-label="The right number"
            value={answer}
            onInput={(event) => set({ ...question, answer: Number(event.currentTarget.value) })}
          />
        </label>
      ) : (
        <div class="edit-check">
          <ValueFields
            name="Value of the answer"
            chosen={answer}
            onChange={(next) => set({ ...question, answer: next })}
          />
          <p class="edit-holds">Now: {foundText(readValue(answer), unitOf(answer))}</p>
        </div>
      )}
      <Tolerance question={question} set={set} />
    </>
  );
}

export function QuestionFields({ question }: { question: Question | undefined }) {
  const set = (next: Question) => editStep({ question: next });
  return (
    <>
      <SelectField
        label="Question"
        value={question?.kind ?? 'none'}
        options={kinds}
        onChange={(kind) =>
          editStep({ question: kind === 'none' ? undefined : fresh[kind](question?.text ?? '') })
        }
      />
      {question && (
        <>
          <TextField
            label={question.kind === 'do' ? 'What is to be done' : 'What is asked'}
            rows={2}
            value={question.text}
            onChange={(text) => set({ ...question, text })}
          />
          {question.kind === 'choice' && <ChoiceFields question={question} set={set} />}
          {question.kind === 'number' && <NumberFields question={question} set={set} />}
          {question.kind === 'do' && (
            <ChecksFields checks={question.checks} onChange={(checks) => set({ ...question, checks })} />
          )}
        </>
      )}
    </>
  );
}
