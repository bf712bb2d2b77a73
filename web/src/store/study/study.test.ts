import { beforeEach, describe, expect, it } from 'vitest';
import { notices } from '../notices';
import { readStudy, type StudyRow } from './read_study';
import { filterCounts, sorted, summaryOf } from './rows';
import { histogramOf, isOutlying, spreadOf, usualRange } from './spread';
import { findStudy, openStudy, study, studyShown } from './study';

const line = (number: number, change: Record<string, unknown> = {}) =>
  JSON.stringify({
    case: number,
    key: 'ab'.repeat(32),
    name: `heart ${number}`,
    'source.phantom.scale': 1 + number / 100,
    status: 'done',
    stage: null,
    reason: null,
    tets: 1000 + 10 * number,
    monodomain_last_ms: null,
    link: '#j=%7B%7D',
    ...change,
  });
const failed = { status: 'failed', stage: 'volume', reason: 'b.nii.gz: it is empty', tets: null };
const missing = { status: 'missing', tets: null, link: null };
const table = (...lines: string[]) => ({ name: 'table.jsonl', text: `${lines.join('\n')}\n` });
const head = 'case,seconds,peak_mb,forecast_seconds,forecast_mb';
const costs = (...lines: string[]) => ({ name: 'costs.csv', text: [head, ...lines].join('\n') });
const names = (rows: StudyRow[]) => rows.map(({ name }) => name);

describe('a study is read', () => {
  it('into rows, and columns by what they hold; those without a value are left out', () => {
    const { rows, columns } = readStudy(table(line(1), line(2, failed), line(3, missing)));
    expect(columns.map(({ name, kind }) => [name, kind])).toEqual([
      ['case', 'given'],
      ['source.phantom.scale', 'given'],
      ['tets', 'found'],
    ]);
    expect(rows[1]).toMatchObject({
      case: 2,
      status: 'failed',
      stage: 'volume',
      reason: 'b.nii.gz: it is empty',
    });
    expect(rows[2].link).toBeNull();
    expect(columns.map(({ decimals }) => decimals)).toEqual([0, 2, 0]);
  });

  it('with costs, which belong to cases whatever their order', () => {
    const { rows, columns } = readStudy(table(line(1), line(2)), costs('2,1.5,80,,', '1,2.5,90,2,88'));
    expect(rows.map(({ values }) => [values.seconds, values.peak_mb, values.forecast_mb])).toEqual([
      [2.5, 90, 88],
      [1.5, 80, null],
    ]);
    expect(columns.filter(({ kind }) => kind === 'cost').map(({ name }) => name)).toEqual(
      head.split(',').slice(1),
    );
  });

  it('with lists and groups as their JSON', () => {
    const { rows, columns } = readStudy(table(line(1, { 'source.phantom.scale': [3, 3] })));
    expect(rows[0].values['source.phantom.scale']).toBe('[3,3]');
    expect(columns[1]).toMatchObject({ kind: 'given', numeric: false });
  });

  it('where a case has no costs, they are unknown', () => {
    const { rows } = readStudy(table(line(1), line(2)), costs('1,2.5,90,2,88'));
    expect(rows[1].values.seconds).toBeNull();
    expect(names(sorted(rows, { column: 'seconds', descending: true }))).toEqual(['heart 1', 'heart 2']);
  });

  const without = (field: string) => line(2, { [field]: undefined });
  it.each([
    ['no JSON', '{"case": 2,', 'table.jsonl, line 2: found "{"case": 2,", which is no JSON'],
    ['no object', '[2]', 'table.jsonl, line 2: found [2], expected a case of the study as a JSON object.'],
    ['no status', without('status'), 'line 2: found no field "status", expected done, failed or missing.'],
    ['no figure', without('tets'), 'line 2: found no field "tets", expected the fields of line 1.'],
    ['another', line(2, { b: 1 }), 'line 2: found the field "b", expected the fields of line 1 alone.'],
    ['a status', line(2, { status: 'ok' }), 'line 2: found "ok" in "status", expected done, failed or'],
    ['a number', line(2, { case: 0.5 }), 'line 2: found 0.5 in "case", expected a whole number from 1 on.'],
    ['a link', line(2, { link: 'https://a' }), 'line 2: found "https://a" in "link", expected a link that'],
    ['a case twice', line(1), 'line 2: found case 1, expected another one: line 1 is that case.'],
  ])('not with %s', (_, second, message) => {
    expect(() => readStudy(table(line(1), second))).toThrow(message);
  });

  it('not without a case', () => {
    expect(() => readStudy(table(''))).toThrow('table.jsonl: found no line');
  });

  it.each([
    ['1,2', 'costs.csv, line 2: found 2 values, expected 5: case,seconds'],
    ['1,soon,1,1,1', 'costs.csv, line 2: found "soon" in "seconds", expected a number or nothing.'],
    ['7,1,1,1,1', 'costs.csv, line 2: found case 7, expected a case of the table.'],
  ])('not with the costs %s', (row, message) => {
    expect(() => readStudy(table(line(1)), costs(row))).toThrow(message);
  });
});

describe('rows', () => {
  const read = () => readStudy(table(line(10), line(9, failed), line(2), line(1, missing)));

  it('are summed up in words, and counted by what is shown', () => {
    expect(summaryOf(read())).toBe('4 cases: 2 done, 1 failed, 1 missing');
    expect(summaryOf(readStudy(table(line(1))))).toBe('1 case: 1 done');
    expect(filterCounts(read())).toEqual([
      ['all', 4],
      ['done', 2],
      ['failed', 1],
      ['missing', 1],
    ]);
  });

  it('are sorted as one counts, those without a value last either way', () => {
    const { rows } = read();
    const by = (column: string, descending = false) => names(sorted(rows, { column, descending }));
    expect(by('name')).toEqual(['heart 1', 'heart 2', 'heart 9', 'heart 10']);
    expect(by('tets')).toEqual(['heart 2', 'heart 10', 'heart 9', 'heart 1']);
    expect(by('tets', true)).toEqual(['heart 10', 'heart 2', 'heart 9', 'heart 1']);
  });
});

describe('outliers', () => {
  it('lie beyond the outer fences', () => {
    const spread = spreadOf([100, 1, 2, 3, 4]);
    expect(spread).toEqual({ low: 2, median: 3, high: 4 });
    expect(usualRange(spread)).toEqual([-4, 10]);
    expect([-4, 10, -4.1, 10.1].map((value) => isOutlying(value, spread))).toEqual([
      false,
      false,
      true,
      true,
    ]);
  });

  it('are all that differ where most values are the same', () => {
    const spread = spreadOf([0, 0, 0, 0, 1]);
    expect([0, 1].map((value) => isOutlying(value, spread))).toEqual([false, true]);
  });

  it('are named in the rows, by figures and costs, not by what was given', () => {
    const lines = Array.from({ length: 9 }, (_, i) => line(i + 1, { tets: i === 4 ? 5000 : 1000 + i }));
    lines[7] = line(800, { tets: 1004, 'source.phantom.scale': 90 });
    const read = readStudy(
      table(...lines),
      costs('1,1,1,,', '2,1,2,,', '3,1,3,,', '4,1,99,,', '5,1,2,,', '6,1,3,,'),
    );
    const found = read.rows.filter(({ outlying }) => outlying.length > 0);
    expect(found.map((row) => [row.name, row.outlying])).toEqual([
      ['heart 4', ['peak_mb']],
      ['heart 5', ['tets']],
    ]);
    expect(filterCounts(read).at(-1)).toEqual(['outliers', 2]);
  });

  it('stand in a histogram that holds every value, even one alone', () => {
    const { lo, hi, counts } = histogramOf([0, 1, 2, 10]);
    expect([lo, hi, counts]).toEqual([0, 10, [2, 1, 0, 0, 1]]);
    expect(histogramOf([3])).toEqual({ lo: 2.5, hi: 3.5, counts: [0, 0, 1, 0, 0] });
    expect(histogramOf(Array.from({ length: 1500 }, (_, i) => i)).counts).toHaveLength(56);
  });
});

describe('files of a study', () => {
  beforeEach(() => {
    study.value = null;
    studyShown.value = false;
    notices.value = [];
  });
  const file = ({ name, text }: { name: string; text: string }) => new File([text], name);
  const other = new File(['name,voxels\n'], 'labels.csv');

  it('are known by what is in them', async () => {
    const rows = file({ ...table(line(1)), name: 'hearts.txt' });
    const cost = file({ ...costs('1,2,3,4,5'), name: 'what.csv' });
    expect(await findStudy([other, cost, rows])).toEqual({ table: rows, costs: cost, rest: [other] });
    expect(await findStudy([other, new File(['{"sizing": {"edge_mm": 3}}'], 'a.case.json')])).toBeNull();
  });

  it('are known by their first line however long its link is', async () => {
    const text = line(1, { link: `#c1=${'a'.repeat(1 << 17)}` });
    expect(await findStudy([new File([text], 'one.json')])).not.toBeNull();
  });

  it('open in front of the case', async () => {
    await openStudy({ table: file(table(line(1))), costs: file(costs('1,2,3,4,5')), rest: [] });
    expect([studyShown.value, study.value?.rows[0].values.peak_mb]).toEqual([true, 3]);
    const first = study.value?.id;
    await openStudy({ table: file(table(line(1))), costs: undefined, rest: [] });
    expect(study.value?.id).not.toBe(first);
  });

  it('that cannot be read leave the study that is open, and say why', async () => {
    await openStudy({ table: file(table(line(1))), costs: undefined, rest: [] });
    const before = study.value;
    const broken = (await findStudy([file({ name: 'table.jsonl', text: 'name\n' })]))!;
    await openStudy(broken);
    expect(study.value).toBe(before);
    expect(notices.value.map(({ text }) => text)).toEqual([
      'table.jsonl, line 1: found "name", which is no JSON, expected a case of the study as a JSON object.',
    ]);
  });
});
