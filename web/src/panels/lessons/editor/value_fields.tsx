/** Which value of the app, and what is asked of it; with what it is now. */
import { holds, unitOf } from '../../../lessons/checks';
import type { Check, ValueRef } from '../../../lessons/lesson';
import { allValues, readValue, valueNamed } from '../../../lessons/values';
import { recipe } from '../../../store/case/recipe';
import { RemoveButton } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';
import { foundText } from '../live_values';

const groups = [...new Set(allValues.map(({ group }) => group))];

/** A value with the label that it needs, and no more than it can have. */
function fitted(ref: ValueRef): ValueRef {
  const { ofLabel, ofRun } = valueNamed(ref.value)!;
  return {
    value: ref.value,
    ...(ofLabel ? { label: ref.label ?? recipe.value?.labels[0] ?? 1 } : {}),
    ...(ofRun && ref.per ? { per: ref.per } : {}),
  };
}

export function ValueFields(props: { name: string; chosen: ValueRef; onChange(next: ValueRef): void }) {
  const { name, chosen, onChange } = props;
  const known = valueNamed(chosen.value);
  return (
    <>
      <select
        aria-label={name}
        value={chosen.value}
        onChange={(event) => onChange(fitted({ ...chosen, value: event.currentTarget.value }))}
      >
        {groups.map((group) => (
          <optgroup key={group} label={group}>
            {allValues
              .filter((value) => value.group === group)
              .map((value) => (
                <option key={value.name} value={value.name} selected={value.name === chosen.value}>
                  {value.title}
                </option>
              ))}
          </optgroup>
        ))}
      </select>
      {known?.ofLabel && (
        <label class="edit-inline">
          <span>of label</span>
          <input
            type="number"
            min={1}
            max={65535}
            aria-label={`${name}: label`}
            value={chosen.label}
            onInput={(event) => onChange({ ...chosen, label: Number(event.currentTarget.value) })}
          />
        </label>
      )}
      {known?.ofRun && (
        <label class="edit-inline">
          <input
            type="checkbox"
            aria-label={`${name}: over the pinned run’s`}
            checked={chosen.per === 'pinned'}
            onChange={(event) =>
              onChange(fitted({ ...chosen, per: event.currentTarget.checked ? 'pinned' : undefined }))
            }
          />
          <span>over that of the pinned run</span>
        </label>
      )}
    </>
  );
}

type Bound = 'min' | 'max' | 'equal';
const bounds: readonly [Bound, string][] = [
  ['min', 'at least'],
  ['max', 'at most'],
  ['equal', 'equal to'],
];

/** A number, or the text of a value that is no number. */
function boundOf(typed: string, found: unknown): number | string | undefined {
  if (typed.trim() === '') return undefined;
  return typeof found === 'string' || Number.isNaN(Number(typed)) ? typed : Number(typed);
}

/** Whether it holds now is read aloud only when asked: it changes with every run. */
function HoldsNow({ check }: { check: Check }) {
  const now = foundText(readValue(check), unitOf(check));
  const right = holds(check);
  return (
    <p class={right ? 'edit-holds yes' : 'edit-holds'} data-testid="holds-now">
      <Icon name={right ? 'check' : 'cross'} size={13} /> {right ? 'Holds now' : 'Does not hold now'}: {now}
    </p>
  );
}

function CheckFields(props: { name: string; check: Check; onChange(next: Check): void; onRemove(): void }) {
  const { name, check, onChange } = props;
  const found = readValue(check);
  return (
    <div class="edit-check" role="group" aria-label={name}>
      <ValueFields
        name={`${name}: value`}
        chosen={check}
        onChange={(ref) => {
          const { min, max, equal } = check;
          onChange({ ...ref, min, max, equal });
        }}
      />
      <div class="edit-bounds">
        {bounds.map(([bound, words]) => (
          <label key={bound} class="edit-inline">
            <span>{words}</span>
            <input
              type="text"
              aria-label={`${name}: ${words}`}
              value={check[bound] ?? ''}
              onChange={(event) => onChange({ ...check, [bound]: boundOf(event.currentTarget.value, found) })}
            />
          </label>
        ))}
        <RemoveButton what={name.toLowerCase()} onRemove={props.onRemove} />
      </div>
      <HoldsNow check={check} />
    </div>
  );
}

export function ChecksFields(props: { checks: Check[]; onChange(next: Check[]): void }) {
  const { checks, onChange } = props;
  return (
    <>
      {checks.map((check, i) => (
        <CheckFields
          key={i}
          name={`Check ${i + 1}`}
          check={check}
          onChange={(next) => onChange(checks.with(i, next))}
          onRemove={() => onChange(checks.toSpliced(i, 1))}
        />
      ))}
      <button
        type="button"
        class="button small"
        onClick={() => onChange([...checks, { value: 'run.done', equal: 1 }])}
      >
        <Icon name="plus" size={13} /> Check
      </button>
    </>
  );
}
