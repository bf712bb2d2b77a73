/** What is accepted as a lesson. Whatever comes in is untrusted: every field is known, and bounded in size. */
import { controlNames } from '../store/case/keep/lesson_asked';
import { stageNames } from '../engine/contract';
import { depthExceeds, maxDepth } from '../link/codec';
import type { Check, Lesson, Option, Picture, Question, Step, StepView, ValueRef } from './lesson';
import { valueNamed } from './values';

export const maxSteps = 40;
export const maxPictureChars = 200_000;
export const maxLessonChars = 1 << 20;

export class LessonError extends Error {
  override readonly name = 'LessonError';
}

/** Reads a value that stands at `path`, "step 3, question.text". Throws LessonError with that place. */
type Read<T> = (value: unknown, path: string) => T;

function kindOf(value: unknown): string {
  if (value === null || value === undefined) return 'nothing';
  if (Array.isArray(value)) return 'a list';
  if (typeof value === 'string') return value.length > 40 ? 'a long text' : `"${value}"`;
  return typeof value === 'object' ? 'an object' : String(value);
}

function refuse(path: string, found: unknown, expected: string): never {
  throw new LessonError(`${path || 'The lesson'}: found ${kindOf(found)}, expected ${expected}.`);
}

const text =
  (most: number, least = 1): Read<string> =>
  (value, path) => {
    if (typeof value !== 'string') refuse(path, value, 'a text');
    if (value.trim().length < least) refuse(path, value, 'a text that is not empty');
    if (value.length > most)
      throw new LessonError(`${path}: ${value.length} characters, expected at most ${most}.`);
    return value;
  };

const number =
  (least = -1e12, most = 1e12): Read<number> =>
  (value, path) =>
    typeof value === 'number' && value >= least && value <= most
      ? value
      : refuse(path, value, least > -1e12 ? `a number from ${least} to ${most}` : 'a number');

const flag: Read<boolean> = (value, path) =>
  typeof value === 'boolean' ? value : refuse(path, value, 'true or false');

const oneOf =
  <T extends string>(...names: readonly T[]): Read<T> =>
  (value, path) =>
    names.find((name) => name === value) ?? refuse(path, value, `one of ${names.join(', ')}`);

const list =
  <T>(read: Read<T>, most: number, least = 0): Read<T[]> =>
  (value, path) => {
    if (!Array.isArray(value)) refuse(path, value, 'a list');
    if (value.length < least || value.length > most)
      throw new LessonError(`${path}: ${value.length} entries, expected ${least} to ${most}.`);
    return value.map((entry, i) => read(entry, `${path}[${i + 1}]`));
  };

type Fields<T> = { [K in keyof T]-?: undefined extends T[K] ? [Read<NonNullable<T[K]>>] : Read<T[K]> };

/** An object of these fields and no others; those in brackets may be absent. */
const object =
  <T extends object>(fields: Fields<T>, at = (path: string, key: string) => `${path}.${key}`): Read<T> =>
  (value, path) => {
    if (value === null || typeof value !== 'object' || Array.isArray(value)) refuse(path, value, 'an object');
    const given = value as Record<string, unknown>;
    const names = Object.keys(fields);
    for (const key of Object.keys(given))
      if (!names.includes(key))
        throw new LessonError(
          `${at(path, key.slice(0, 40))}: there is no such field; expected ${names.join(', ')}.`,
        );
    const read: Record<string, unknown> = {};
    for (const [key, field] of Object.entries(fields) as [string, Read<unknown> | [Read<unknown>]][]) {
      if (given[key] !== undefined)
        read[key] = (Array.isArray(field) ? field[0] : field)(given[key], at(path, key));
      else if (!Array.isArray(field)) refuse(at(path, key), undefined, 'a value');
    }
    return read as T;
  };

const knownValue: Read<string> = (value, path) =>
  typeof value === 'string' && valueNamed(value) ? value : refuse(path, value, 'the name of a value');

const refFields: Fields<ValueRef> = {
  value: knownValue,
  label: [number(1, 65535)],
  per: [oneOf('pinned')],
};

/** A label and a pinned run only where the value has them. */
function fits(ref: ValueRef, path: string): void {
  const known = valueNamed(ref.value)!;
  if (known.ofLabel !== (ref.label !== undefined))
    throw new LessonError(
      `${path}.label: ${ref.value} ${known.ofLabel ? 'is of one label, expected its number' : 'is of no label'}.`,
    );
  if (ref.per && !known.ofRun) throw new LessonError(`${path}.per: a pinned run has no ${ref.value}.`);
}

const valueRef: Read<ValueRef> = (value, path) => {
  const ref = object<ValueRef>(refFields)(value, path);
  fits(ref, path);
  return ref;
};

const check: Read<Check> = (value, path) => {
  const read = object<Check>({
    ...refFields,
    min: [number()],
    max: [number()],
    equal: [(found, at) => (typeof found === 'string' ? text(60)(found, at) : number()(found, at))],
  })(value, path);
  fits(read, path);
  const { min, max, equal } = read;
  if (min === undefined && max === undefined && equal === undefined)
    throw new LessonError(`${path}: expected min, max or equal.`);
  return read;
};

const checks = list(check, 8, 1);

const option = object<Option>({
  text: text(300),
  right: [flag],
  when: [checks],
  say: [text(600)],
});

const questions: { [K in Question['kind']]: Read<Extract<Question, { kind: K }>> } = {
  choice(value, path) {
    const read = object<Extract<Question, { kind: 'choice' }>>({
      kind: oneOf('choice'),
      text: text(1000),
      options: list(option, 6, 2),
    })(value, path);
    if (!read.options.some(({ right, when }) => right || when))
      throw new LessonError(`${path}.options: none of them is right.`);
    return read;
  },
  number(value, path) {
    const read = object<Extract<Question, { kind: 'number' }>>({
      kind: oneOf('number'),
      text: text(1000),
      unit: [text(12)],
      answer: (found, at) => (typeof found === 'number' ? number()(found, at) : valueRef(found, at)),
      times: [number()],
      within: [number(0, 1e9)],
      percent: [number(0, 100)],
    })(value, path);
    if ((read.within === undefined) === (read.percent === undefined))
      throw new LessonError(`${path}: expected within or percent, and not both.`);
    return read;
  },
  do: object<Extract<Question, { kind: 'do' }>>({ kind: oneOf('do'), text: text(1000), checks }),
};

const question: Read<Question> = (value, path) => {
  const kind = oneOf('choice', 'number', 'do')((value as { kind?: unknown } | null)?.kind, `${path}.kind`);
  return questions[kind](value, path);
};

const picture = object<Picture>({
  source(value, path) {
    const source = text(maxPictureChars)(value, path);
    const isData = /^data:image\/(png|jpeg|webp|gif);base64,[A-Za-z0-9+/=]+$/.test(source);
    const isFile = /^(?:[\w-]+\/)*[\w-]+\.(?:png|jpe?g|webp|svg)$/.test(source);
    return isData || isFile
      ? source
      : refuse(path, value, 'data:image/…;base64,… or the name of a picture beside the page');
  },
  alt: text(300),
});

const view = object<StepView>({
  layout: [oneOf('model', 'slices', 'compare')],
  slices: [oneOf('labels', 'size', 'thickness')],
  colour: [text(60)],
  cut: [flag],
  edges: [flag],
  stage: [oneOf(...stageNames)],
});

/** A case as such; its fields are for the engine to read. */
const caseOf: Read<Record<string, unknown>> = (value, path) => {
  if (value === null || typeof value !== 'object' || Array.isArray(value)) refuse(path, value, 'a case');
  return value as Record<string, unknown>;
};

const step = object<Step>(
  {
    title: text(120),
    text: text(6000),
    picture: [picture],
    case: [caseOf],
    view: [view],
    allow: [list(oneOf(...controlNames), controlNames.length)],
    show: [list(valueRef, 8)],
    question: [question],
    hints: [list(text(600), 5)],
    right: [text(600)],
    wrong: [text(600)],
  },
  (path, key) => (/^Step \d+$/.test(path) ? `${path}, ${key}` : `${path}.${key}`),
);

const steps: Read<Step[]> = (value, path) => {
  list(caseOf, maxSteps, 1)(value, path);
  return (value as unknown[]).map((one, i) => step(one, `Step ${i + 1}`));
};

const lesson = object<Lesson>(
  {
    version(value, path) {
      return value === 1 ? 1 : refuse(path, value, '1: this page knows no later lessons');
    },
    title: text(120),
    language(value, path) {
      const tag = text(35)(value, path);
      return /^[a-z]{2,3}(-[A-Za-z0-9]{2,8})*$/.test(tag) ? tag : refuse(path, value, 'a language, as "en"');
    },
    summary: text(1000),
    author: [text(120)],
    minutes: [number(1, 600)],
    steps,
  },
  (_, key) => key,
);

/** A lesson from what JSON gave. */
export function readLesson(value: unknown): Lesson {
  if (depthExceeds(value, maxDepth))
    throw new LessonError(`The lesson nests deeper than ${maxDepth} levels.`);
  return lesson(value, '');
}

/** A lesson from a file's text. */
export function parseLesson(json: string): Lesson {
  if (json.length > maxLessonChars) throw new LessonError('The lesson holds more than 1 MB.');
  let value: unknown;
  try {
    value = JSON.parse(json);
  } catch {
    throw new LessonError('The lesson is no JSON: it is cut short or damaged.');
  }
  return readLesson(value);
}
