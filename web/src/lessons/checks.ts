/** Whether answers are right: by the values of the app as they are now. */
import { computed } from '@preact/signals';
import type { Check, ChoiceQuestion, NumberQuestion, Option, ValueRef } from './lesson';
import { readValue, valueNamed, type Found } from './values';

/** The bounds count as within, and rounding does not decide. */
const slack = 1e-9;

export function meets({ min, max, equal }: Check, found: Found): boolean {
  if (found === null) return false;
  if (typeof equal === 'string' || typeof found === 'string') return found === equal;
  const within = slack * Math.max(1, Math.abs(found));
  return (
    (min === undefined || found >= min - within) &&
    (max === undefined || found <= max + within) &&
    (equal === undefined || Math.abs(found - equal) <= within)
  );
}

export const holds = (check: Check): boolean => meets(check, readValue(check));
export const allHold = (checks: readonly Check[]): boolean => checks.every(holds);

export const isRight = ({ right, when }: Option): boolean =>
  right === true || (when !== undefined && allHold(when));

/** Whether the app can tell now which options are right. */
export function decidable({ options }: ChoiceQuestion): boolean {
  return options.every(({ when }) => (when ?? []).every((check) => readValue(check) !== null));
}

export function expectedNumber({ answer, times = 1 }: NumberQuestion): number | null {
  if (typeof answer === 'number') return answer;
  const found = readValue(answer);
  return typeof found === 'number' ? times * found : null;
}

/** Null where the app has no number to compare with. */
export function isNumberRight(question: NumberQuestion, given: number): boolean | null {
  const expected = expectedNumber(question);
  if (expected === null) return null;
  const { within = 0, percent = 0 } = question;
  const allowed = Math.max(within, (percent / 100) * Math.abs(expected));
  return Math.abs(given - expected) <= allowed + slack * Math.max(1, Math.abs(expected));
}

/**
 * What a pupil may mean by a number as typed: a comma is a decimal point, or stands between thousands, as the app
 * writes them. "5,027" can be either.
 */
export function numbersTyped(text: string): number[] {
  const typed = text.trim().replace('−', '-');
  const readings = [typed.replace(',', '.')];
  if (/^[+-]?\d{1,3}(,\d{3})+(\.\d*)?$/.test(typed)) readings.push(typed.replaceAll(',', ''));
  return readings.filter((one) => /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(one)).map(Number);
}

/** A value as a signal, for whoever shows it. */
export const valueSignal = (ref: ValueRef) => computed(() => readValue(ref));

/** A value in words, as in "Tetrahedra, of the pinned run's". */
export function titleOf({ value, label, per }: ValueRef): string {
  const { title } = valueNamed(value)!;
  return `${title}${label === undefined ? '' : ` of label ${label}`}${per ? ', over the pinned run’s' : ''}`;
}

export const unitOf = ({ value, per }: ValueRef): string => (per ? '' : valueNamed(value)!.unit);

/** What a check asks, for the teacher. */
export function wordsOf(check: Check): string {
  const { min, max, equal } = check;
  const bounds = [
    equal === undefined ? '' : `is ${equal}`,
    min === undefined ? '' : `is at least ${min}`,
    max === undefined ? '' : `is at most ${max}`,
  ].filter(Boolean);
  return `${titleOf(check)} ${bounds.join(' and ')} ${unitOf(check)}`.trim();
}
