import { useEffect, useId, useState } from 'preact/hooks';
import type { SchemaField, Vec3 } from '../../engine/contract';
import { schema } from '../../store/run/stages';
import { Explain } from './explain';

/** A field of the engine's table, by its path; list items by `list.item`. */
export function fieldOf(path: string): SchemaField | undefined {
  let fields = schema.value?.fields;
  let rest = path;
  while (fields) {
    const exact = fields.find((field) => field.path === rest);
    if (exact) return exact;
    const list: SchemaField | undefined = fields.find(
      (field) => field.items && rest.startsWith(`${field.path}.`),
    );
    if (!list) return undefined;
    rest = rest.slice(list.path.length + 1);
    fields = list.items;
  }
  return undefined;
}

/** What an input's text stands for; nothing in an empty one. */
const numberOf = (typed: string): number | null => (typed.trim() === '' ? null : Number(typed));

interface NumberInputProps {
  label: string;
  value: number | null;
  onChange(value: number | null): void;
  path?: string;
  /** Shown where nothing is set; an empty input then means "nothing set". */
  placeholder?: string;
  step?: number;
  disabled?: boolean;
}

/** A number with its range from the engine's table. What is typed takes effect as soon as it is in range. */
export function NumberInput({ label, value, onChange, path, placeholder, step, disabled }: NumberInputProps) {
  const field = path ? fieldOf(path) : undefined;
  const [draft, setDraft] = useState<string | null>(null);
  const [wrong, setWrong] = useState(false);
  useEffect(() => {
    setWrong(false);
    // What was typed no longer holds where the value has become another, by undo for one.
    setDraft((typed) => (typed !== null && numberOf(typed) !== value ? null : typed));
  }, [value]);
  const text = draft ?? (value === null ? '' : String(value));
  const take = (typed: string) => {
    setDraft(typed);
    const number = numberOf(typed);
    if (number === null) {
      setWrong(placeholder === undefined);
      if (placeholder !== undefined) onChange(null);
      return;
    }
    const inRange =
      Number.isFinite(number) &&
      !(field?.min !== undefined && number < field.min) &&
      !(field?.max !== undefined && number > field.max) &&
      !(field?.type === 'integer' && !Number.isInteger(number));
    setWrong(!inRange);
    if (inRange) onChange(number);
  };
  const range = field?.min !== undefined && field.max !== undefined ? ` (${field.min} to ${field.max})` : '';
  return (
    <input
      class={wrong ? 'number wrong' : 'number'}
      type="number"
      inputMode="decimal"
      aria-label={label}
      aria-invalid={wrong}
      title={field?.description ? `${field.description}${range}` : label}
      value={text}
      step={step ?? 'any'}
      min={field?.min}
      max={field?.max}
      placeholder={placeholder}
      disabled={disabled}
      onInput={(event) => take(event.currentTarget.value)}
      onBlur={() => {
        setDraft(null);
        setWrong(false);
      }}
    />
  );
}

/** A number of the engine's table with its label. `owner`: what it belongs to, where several look alike. */
export function NumberField(props: {
  label: string;
  path: string;
  value: number;
  unit?: string;
  step?: number;
  owner?: string;
  onChange(value: number): void;
}) {
  const { label, path, value, unit, step, owner } = props;
  return (
    <div class="field">
      <span class="field-label">{label}</span>
      <Explain of={label} text={fieldOf(path)?.description} />
      <span class="field-input">
        <NumberInput
          label={owner === undefined ? label : `${owner}: ${label}`}
          path={path}
          step={step}
          value={value}
          onChange={(next) => next !== null && props.onChange(next)}
        />
        <span class="unit">{unit}</span>
      </span>
    </div>
  );
}

export function VectorField(props: {
  label: string;
  unit?: string;
  value: Vec3;
  names?: string[];
  path?: string;
  step?: number;
  onChange(value: Vec3): void;
}) {
  const names = props.names ?? ['R', 'A', 'S'];
  return (
    <div class="field field-vector">
      <span class="field-label">{props.label}</span>
      <span class="field-input vector">
        {names.map((name, axis) => (
          <label class="axis" key={name}>
            <span>{name}</span>
            <NumberInput
              label={`${props.label} ${name}`}
              path={props.path}
              step={props.step ?? 1}
              value={props.value[axis]}
              onChange={(part) =>
                props.onChange(props.value.map((old, i) => (i === axis ? (part ?? old) : old)) as Vec3)
              }
            />
          </label>
        ))}
      </span>
    </div>
  );
}

export function SelectField<T extends string>(props: {
  label: string;
  value: T;
  options: readonly (readonly [T, string])[];
  onChange(value: T): void;
  hint?: string;
}) {
  const id = useId();
  return (
    <div class="field" title={props.hint}>
      <label class="field-label" for={id}>
        {props.label}
      </label>
      <Explain of={props.label} text={props.hint} />
      <span class="field-input">
        <select
          id={id}
          value={props.value}
          onChange={(event) => props.onChange(event.currentTarget.value as T)}
        >
          {props.options.map(([value, text]) => (
            <option key={value} value={value} selected={value === props.value}>
              {text}
            </option>
          ))}
        </select>
      </span>
    </div>
  );
}

export function CheckField(props: {
  label: string;
  checked: boolean;
  onChange(checked: boolean): void;
  hint?: string;
}) {
  return (
    <div class="check-row" title={props.hint}>
      <label class="check">
        <input
          type="checkbox"
          checked={props.checked}
          onChange={(event) => props.onChange(event.currentTarget.checked)}
        />
        <span>{props.label}</span>
      </label>
      <Explain of={props.label} text={props.hint} />
    </div>
  );
}

/** A few exclusive choices side by side. */
export function Segments<T extends string>(props: {
  label: string;
  value: T;
  options: readonly (readonly [T, string, string?])[];
  disabled?: readonly T[];
  onChange(value: T): void;
}) {
  return (
    <div class="segments" role="group" aria-label={props.label}>
      {props.options.map(([value, text, title]) => (
        <button
          type="button"
          key={value}
          title={title}
          aria-pressed={props.value === value}
          disabled={props.disabled?.includes(value)}
          onClick={() => props.onChange(value)}
        >
          {text}
        </button>
      ))}
    </div>
  );
}

interface SliderProps {
  name: string;
  value: number;
  onValue(value: number): void;
  min?: number;
  max?: number;
  step?: number;
}

/** From 0 to 1 where nothing else is said. */
export function Slider({ name, value, onValue, min = 0, max = 1, step = 0.005 }: SliderProps) {
  return (
    <input
      type="range"
      min={min}
      max={max}
      step={step}
      value={value}
      aria-label={name}
      onInput={(event) => onValue(Number(event.currentTarget.value))}
    />
  );
}
