/** The table of a study, `table.jsonl`, and what its cases cost, `costs.csv`: text to rows and columns. */
import { isCaseFragment } from '../../link/codec';
import { isOutlying, spreadOf, type Spread } from './spread';

export type Value = number | string | boolean | null;
export const statuses = ['done', 'failed', 'missing'] as const;
export type Status = (typeof statuses)[number];

/** A case of a study and what came of it. */
export interface StudyRow {
  case: number;
  name: string;
  status: Status;
  /** Where it failed, and why. */
  stage: string | null;
  reason: string | null;
  /** The case as a link of the app, with what it promises where it is done. */
  link: string | null;
  /** By the name of the column. */
  values: Record<string, Value>;
  /** Columns in which its value is an outlier. */
  outlying: string[];
}

export interface StudyColumn {
  name: string;
  /** What the case was given, what was found, what it cost. */
  kind: 'given' | 'found' | 'cost';
  numeric: boolean;
  /** So many decimals give each of its numbers three digits that count, up to four decimals. */
  decimals: number;
  /** Of numbers that were found, where they differ. */
  spread: Spread | null;
}

export interface Study {
  rows: StudyRow[];
  columns: StudyColumn[];
}

export interface NamedText {
  name: string;
  text: string;
}

type Fields = Record<string, Value>;

function fault(file: string, line: number, found: string, expected: string): Error {
  return new Error(`${file}, line ${line}: found ${found}, expected ${expected}.`);
}

/** A value as an error shows it. */
function shown(value: unknown): string {
  const text = typeof value === 'string' ? value : JSON.stringify(value);
  const start = text.length > 40 ? `${text.slice(0, 40)}…` : text;
  return typeof value === 'string' ? `"${start}"` : start;
}

const isTextOrNull = (value: Value) => value === null || typeof value === 'string';

/** What a case was given may be a list or a group: it stands in the table as its JSON. */
const asValue = (entry: unknown): Value =>
  entry !== null && typeof entry === 'object' ? JSON.stringify(entry) : (entry as Value);

/** The fields of every row, what is expected of them, and whether it holds. */
const rowFields: Record<string, [expected: string, holds: (value: Value) => boolean]> = {
  case: ['a whole number from 1 on', (value) => Number.isInteger(value) && Number(value) >= 1],
  key: ['a text or null', isTextOrNull],
  name: ['a text', (value) => typeof value === 'string'],
  status: [
    statuses.join(', ').replace(/, (\w+)$/, ' or $1'),
    (value) => statuses.some((one) => one === value),
  ],
  stage: ['a text or null', isTextOrNull],
  reason: ['a text or null', isTextOrNull],
  link: [
    'a link that starts with #c1= or #j=, or null',
    (value) => value === null || (typeof value === 'string' && isCaseFragment(value)),
  ],
};

function fieldsOfLine(file: string, line: number, text: string): Fields {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw fault(file, line, `${shown(text)}, which is no JSON`, 'a case of the study as a JSON object');
  }
  if (value === null || typeof value !== 'object' || Array.isArray(value))
    throw fault(file, line, shown(value), 'a case of the study as a JSON object');
  const fields = value as Fields;
  for (const [name, [expected, holds]] of Object.entries(rowFields)) {
    if (!Object.hasOwn(fields, name)) throw fault(file, line, `no field "${name}"`, expected);
    if (!holds(fields[name])) throw fault(file, line, `${shown(fields[name])} in "${name}"`, expected);
  }
  return Object.fromEntries(Object.entries(fields).map(([name, entry]) => [name, asValue(entry)]));
}

/** Lines with something in them, numbered from 1. */
const linesOf = (text: string): [number, string][] =>
  text.split(/\r?\n/).flatMap((line, i) => (line.trim() ? [[i + 1, line]] : []));

/** The rows as they stand in the file: they have the same fields, and no case comes twice. */
function readTable({ name: file, text }: NamedText): Fields[] {
  const seen = new Map<Value, number>();
  let first: { line: number; names: string[] } | undefined;
  const rows = linesOf(text).map(([line, content]) => {
    const fields = fieldsOfLine(file, line, content);
    first ??= { line, names: Object.keys(fields) };
    const { names } = first;
    const [lacks, extra] = [
      names.find((name) => !Object.hasOwn(fields, name)),
      Object.keys(fields).find((name) => !names.includes(name)),
    ];
    if (lacks) throw fault(file, line, `no field "${lacks}"`, `the fields of line ${first.line}`);
    if (extra) throw fault(file, line, `the field "${extra}"`, `the fields of line ${first.line} alone`);
    const before = seen.get(fields.case);
    if (before) throw fault(file, line, `case ${fields.case}`, `another one: line ${before} is that case`);
    seen.set(fields.case, line);
    return fields;
  });
  if (rows.length === 0) throw new Error(`${file}: found no line, expected one for each case of the study.`);
  return rows;
}

/** Numbers by name for each case, null where there are none. */
function readCosts({ name: file, text }: NamedText, cases: ReadonlySet<Value>): Map<Value, Fields> {
  const [[, head], ...lines] = linesOf(text);
  const names = head.split(',');
  return new Map(
    lines.map(([line, content]) => {
      const parts = content.split(',');
      if (parts.length !== names.length)
        throw fault(file, line, `${parts.length} values`, `${names.length}: ${head}`);
      const values = parts.map((part, i) => {
        const number = part === '' ? null : Number(part);
        if (number !== null && !Number.isFinite(number))
          throw fault(file, line, `${shown(part)} in "${names[i]}"`, 'a number or nothing');
        return number;
      });
      const { case: of, ...costs } = Object.fromEntries(names.map((name, i) => [name, values[i]]));
      if (!cases.has(of)) throw fault(file, line, `case ${of}`, 'a case of the table');
      return [of, costs];
    }),
  );
}

/** What is a whole number needs none. */
function decimalsOf(value: number): number {
  const all = String(value).split('.')[1]?.length ?? 0;
  return Math.min(all, 4, Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value)))));
}

function columnOf(name: string, kind: StudyColumn['kind'], rows: readonly Fields[]): StudyColumn[] {
  const values = rows.map((row) => row[name]).filter((value) => value !== null);
  if (values.length === 0) return [];
  const numeric = values.every((value) => typeof value === 'number');
  const decimals = numeric ? Math.max(...values.map(decimalsOf)) : 0;
  return [{ name, kind, numeric, decimals, spread: numeric && kind !== 'given' ? spreadOf(values) : null }];
}

/**
 * A study from the text of its table and of what its cases cost. Columns without any value are left out. Throws what is
 * wrong in which line of which file.
 */
export function readStudy(table: NamedText, costs?: NamedText): Study {
  const read = readTable(table);
  const costOf = costs && readCosts(costs, new Set(read.map((fields) => fields.case)));
  const costNames = new Set([...(costOf?.values() ?? [])].flatMap((costs) => Object.keys(costs)));
  const unknown = Object.fromEntries([...costNames].map((name) => [name, null]));
  const rows = read.map((fields): Fields => ({ ...fields, ...unknown, ...costOf?.get(fields.case) }));
  const names = Object.keys(read[0]);
  const [from, to] = [names.indexOf('name'), names.indexOf('status')];
  const isGiven = (name: string) => names.indexOf(name) > from && names.indexOf(name) < to;
  const free = names.filter((name) => !Object.hasOwn(rowFields, name));
  const columns = [
    ...columnOf('case', 'given', rows),
    ...free.flatMap((name) => columnOf(name, isGiven(name) ? 'given' : 'found', rows)),
    ...[...costNames].flatMap((name) => columnOf(name, 'cost', rows)),
  ];
  const outlyingIn =
    (values: Fields) =>
    ({ name, spread }: StudyColumn) => {
      const value = values[name];
      return spread !== null && typeof value === 'number' && isOutlying(value, spread);
    };
  return {
    columns,
    rows: rows.map((values) => {
      // Of these types, as each line was checked.
      const { case: number, name, status, stage, reason, link } = values as unknown as StudyRow;
      const outlying = columns.filter(outlyingIn(values)).map((column) => column.name);
      return { case: number, name, status, stage, reason, link, values, outlying };
    }),
  };
}
