import fc from 'fast-check';
import { readFileSync } from 'node:fs';
import { deflateRawSync } from 'node:zlib';
import { afterEach, describe, expect, it } from 'vitest';
import { LinkError } from '../link/codec';
import { chooseLayout } from '../store/view';
import { holds, isNumberRight, meets, numbersTyped, wordsOf } from './checks';
import type { Lesson } from './lesson';
import { decodeLesson, encodeLesson } from './lesson_link';
import { LessonError, maxSteps, parseLesson, readLesson } from './read_lesson';
import { shipped } from './shipped';
import { enclosedMm3, surfaceMm2 } from './shapes';
import { allValues, readValue } from './values';

const small: Lesson = {
  version: 1,
  title: 'Small',
  language: 'en',
  summary: 'One of each question.',
  steps: [
    { title: 'Look', text: 'A case opens.', case: { source: { phantom: { kind: 'sphere' } } } },
    {
      title: 'Choose',
      text: 'Text',
      question: {
        kind: 'choice',
        text: 'Which?',
        options: [
          { text: 'a', right: true },
          { text: 'b', when: [{ value: 'mesh.tets', min: 3 }] },
        ],
      },
    },
    {
      title: 'Number',
      text: 'Text',
      allow: ['sizes', 'run'],
      question: {
        kind: 'number',
        text: 'How many?',
        answer: { value: 'mesh.tets', per: 'pinned' },
        percent: 5,
      },
      hints: ['Count.'],
    },
    {
      title: 'Do',
      text: 'Text',
      question: { kind: 'do', text: 'Run.', checks: [{ value: 'label.dice', label: 1, min: 0.9 }] },
    },
  ],
};

/** The small lesson with one thing of it changed. */
function changed(change: (draft: Record<string, never> & Lesson) => void): unknown {
  const draft = structuredClone(small) as Record<string, never> & Lesson;
  change(draft);
  return draft;
}

const squeezed = (text: string) => `#l1=${deflateRawSync(Buffer.from(text)).toString('base64url')}`;

describe('a lesson that is read', () => {
  it('is what was written', () => {
    expect(readLesson(small)).toEqual(small);
    expect(parseLesson(JSON.stringify(small))).toEqual(small);
  });

  it.each<[string, (draft: Lesson) => void, string]>([
    ['a later version', (draft) => void Object.assign(draft, { version: 2 }), 'version: found 2, expected 1'],
    ['no title', (draft) => void (draft.title = ' '), 'title'],
    ['a language that is none', (draft) => void (draft.language = 'English <b>'), 'language'],
    ['no step', (draft) => void (draft.steps = []), 'steps: 0 entries'],
    [
      'too many steps',
      (draft) => void (draft.steps = Array(maxSteps + 1).fill(small.steps[0])),
      '41 entries',
    ],
    [
      'an unknown field',
      (draft) => void Object.assign(draft.steps[1], { html: '<b>' }),
      'Step 2, html: there is no',
    ],
    [
      'a text that is too long',
      (draft) => void (draft.steps[0].text = 'x'.repeat(6001)),
      'Step 1, text: 6001',
    ],
    [
      'a value that the app has not',
      (draft) => void Object.assign(draft.steps[3].question!, { checks: [{ value: 'constructor', min: 1 }] }),
      'Step 4, question.checks[1].value: found "constructor", expected the name of a value',
    ],
    [
      'a label where none belongs',
      (draft) =>
        void Object.assign(draft.steps[3].question!, { checks: [{ value: 'mesh.tets', label: 1, min: 1 }] }),
      'mesh.tets is of no label',
    ],
    [
      'a value of a label without the label',
      (draft) => void Object.assign(draft.steps[3].question!, { checks: [{ value: 'label.dice', min: 1 }] }),
      'expected its number',
    ],
    [
      'a pinned run where there is none',
      (draft) =>
        void Object.assign(draft.steps[3].question!, {
          checks: [{ value: 'view.cut', per: 'pinned', min: 1 }],
        }),
      'a pinned run has no view.cut',
    ],
    [
      'a check that asks nothing',
      (draft) => void Object.assign(draft.steps[3].question!, { checks: [{ value: 'mesh.tets' }] }),
      'expected min, max or equal',
    ],
    [
      'a question without a right answer',
      (draft) =>
        void Object.assign(draft.steps[1].question!, {
          options: [{ text: 'a' }, { text: 'b', right: false }],
        }),
      'Step 2, question.options: none of them is right',
    ],
    [
      'a kind of question that there is not',
      (draft) => void Object.assign(draft.steps[1].question!, { kind: 'eval' }),
      'Step 2, question.kind: found "eval", expected one of choice, number, do',
    ],
    [
      'a number without tolerance',
      (draft) => void delete (draft.steps[2].question as { percent?: number }).percent,
      'expected within or percent',
    ],
    [
      'a picture from elsewhere',
      (draft) => void (draft.steps[0].picture = { source: 'https://example.org/a.png', alt: 'a' }),
      'Step 1, picture.source',
    ],
    [
      'a picture that is a program',
      (draft) => void (draft.steps[0].picture = { source: 'data:image/svg+xml;base64,AAAA', alt: 'a' }),
      'Step 1, picture.source',
    ],
    [
      'a picture above its folder',
      (draft) => void (draft.steps[0].picture = { source: '../a.png', alt: 'a' }),
      'Step 1, picture.source',
    ],
    [
      'a control that there is not',
      (draft) => void Object.assign(draft.steps[2], { allow: ['everything'] }),
      'Step 3, allow[1]: found "everything"',
    ],
  ])('is refused with %s, and says where', (_, change, words) => {
    const draft = changed(change);
    expect(() => readLesson(draft)).toThrow(LessonError);
    expect(() => readLesson(draft)).toThrow(words);
  });

  it('fails with a LessonError, never otherwise, for any JSON', () => {
    fc.assert(
      fc.property(fc.jsonValue({ maxDepth: 6 }), (value) => {
        expect(() => readLesson(value)).toThrow(LessonError);
      }),
      { numRuns: 300, seed: 48 },
    );
  });

  it('is whole or refused, whichever part of it is replaced by anything', () => {
    const paths: (string | number)[][] = [];
    const walk = (value: unknown, path: (string | number)[]) => {
      if (path.length > 0) paths.push(path);
      if (value !== null && typeof value === 'object')
        for (const key of Object.keys(value)) walk((value as Record<string, unknown>)[key], [...path, key]);
    };
    walk(small, []);
    fc.assert(
      fc.property(fc.constantFrom(...paths), fc.jsonValue({ maxDepth: 3 }), (path, part) => {
        const draft = structuredClone(small) as unknown as Record<string, unknown>;
        let owner = draft;
        for (const key of path.slice(0, -1)) owner = owner[key] as Record<string, unknown>;
        owner[path.at(-1)!] = part;
        try {
          // What is read is known to the last field: it is read again as it is.
          const read = readLesson(draft);
          expect(readLesson(read)).toEqual(read);
        } catch (error) {
          expect(error).toBeInstanceOf(LessonError);
        }
      }),
      { numRuns: 500, seed: 48 },
    );
  });
});

describe('the link of a lesson', () => {
  it('gives back the lesson', async () => {
    expect(await decodeLesson(await encodeLesson(small))).toEqual(small);
    expect(await decodeLesson(squeezed(JSON.stringify(small)))).toEqual(small);
  });

  it('is refused when it is cut short at any place', async () => {
    const whole = await encodeLesson(small);
    for (let length = 4; length < whole.length; length += 3)
      await expect(decodeLesson(whole.slice(0, length))).rejects.toThrow(/damaged|end|base64|UTF-8|JSON/);
  });

  it('fails with a sentence, never otherwise, when characters of it are changed', async () => {
    const whole = await encodeLesson(small);
    await fc.assert(
      fc.asyncProperty(
        fc.integer({ min: 4, max: whole.length - 1 }),
        fc.string({ maxLength: 4 }),
        async (at, junk) => {
          const damaged = whole.slice(0, at) + junk + whole.slice(at + 1);
          await decodeLesson(damaged).then(
            (read) => expect(readLesson(read)).toEqual(read),
            (error: unknown) => expect(error instanceof LessonError || error instanceof LinkError).toBe(true),
          );
        },
      ),
      { numRuns: 300, seed: 48 },
    );
  });

  it('is refused when it inflates beyond 1 MB', async () => {
    await expect(decodeLesson(squeezed(' '.repeat(2 << 20)))).rejects.toThrow('1 MB');
  });
});

describe('the lessons of the page', () => {
  it.each(shipped.map((one) => [one.name, one] as const))('%s is one, of that title', async (_, one) => {
    const read = readLesson(await one.load());
    expect(read.title).toBe(one.title);
    expect(read.steps[0].title).toBe('Free play');
    expect(read.steps[0].question).toBeUndefined();
    expect(read.steps[0].case).toBeDefined();
    for (const { question, hints } of read.steps.slice(1)) {
      expect(question).toBeDefined();
      if (question!.kind !== 'choice') expect(hints?.length ?? 0).toBeGreaterThan(0);
    }
  });
});

it('the heart of the lesson on beats is that of the example, for one beat', async () => {
  const example = JSON.parse(readFileSync('../examples/pv-loops/case.json', 'utf8'));
  example.physics.mechanics.beats = 1;
  const read = readLesson(await shipped.find(({ name }) => name === 'beat')!.load());
  for (const step of read.steps) if (step.case) expect(step.case).toEqual(example);
});

describe('values and checks', () => {
  afterEach(() => chooseLayout('model'));

  it('know each name once', () => {
    const names = allValues.map(({ name }) => name);
    expect(new Set(names).size).toBe(names.length);
    expect(names.length).toBeGreaterThan(60);
  });

  it('have nothing to say before there is a case', () => {
    for (const { name, ofLabel } of allValues) {
      if (/^(view|run|wave|beat\.done|case\.(stimuli|labels))/.test(name)) continue;
      expect([name, readValue({ value: name, label: ofLabel ? 1 : undefined })]).toEqual([name, null]);
    }
    expect(readValue({ value: 'mesh.tets', per: 'pinned' })).toBeNull();
    expect(holds({ value: 'mesh.tets', min: 0 })).toBe(false);
  });

  it('follow the app', () => {
    const compared = { value: 'view.layout', equal: 'slices' };
    expect(holds(compared)).toBe(false);
    chooseLayout('slices');
    expect(holds(compared)).toBe(true);
  });

  it('count bounds as within', () => {
    const check = { value: 'mesh.tets', min: 0.3, max: 2 };
    expect([0.3, 0.1 + 0.2, 2].every((found) => meets(check, found))).toBe(true);
    expect([0.29, 2.001, null, 'x'].some((found) => meets(check, found))).toBe(false);
    expect(meets({ value: 'view.layout', equal: 'model' }, 'model')).toBe(true);
  });

  it('take numbers within what is allowed, in the unit or in percent', () => {
    const question = { kind: 'number', text: '?', answer: 200 } as const;
    expect(isNumberRight({ ...question, percent: 5 }, 210)).toBe(true);
    expect(isNumberRight({ ...question, percent: 5 }, 211)).toBe(false);
    expect(isNumberRight({ ...question, within: 0 }, 200)).toBe(true);
    expect(isNumberRight({ ...question, within: 0.5 }, 199.4)).toBe(false);
    expect(isNumberRight({ ...question, answer: { value: 'mesh.tets' }, within: 1 }, 3)).toBeNull();
  });

  it('read numbers as people type them', () => {
    expect(['2.5', '2,5', ' −3 ', '1e3', '.5'].flatMap(numbersTyped)).toEqual([2.5, 2.5, -3, 1000, 0.5]);
    expect(numbersTyped('5,027')).toEqual([5.027, 5027]);
    expect(numbersTyped('1,234,567')).toEqual([1234567]);
    expect(numbersTyped('5,026.5')).toEqual([5026.5]);
    expect(['', 'two', '1 2', '0x10', 'NaN', '10,00.5'].flatMap(numbersTyped)).toEqual([]);
  });

  it('say what they ask', () => {
    expect(wordsOf({ value: 'sizing.min_mm', min: 1, max: 2 })).toBe(
      'Smallest target edge length is at least 1 and is at most 2 mm',
    );
  });
});

describe('area and volume of a surface', () => {
  it('are those of a unit cube', () => {
    const corner = (i: number) => [i & 1, (i >> 1) & 1, i >> 2];
    const quads = [
      [0, 2, 3, 1],
      [4, 5, 7, 6],
      [0, 1, 5, 4],
      [2, 6, 7, 3],
      [0, 4, 6, 2],
      [1, 3, 7, 5],
    ];
    const cube = {
      points: Float32Array.from([0, 1, 2, 3, 4, 5, 6, 7].flatMap(corner)),
      triangles: Uint32Array.from(quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])),
      sides: Uint16Array.from(Array(12).fill([1, 0]).flat()),
    };
    expect(surfaceMm2(cube)).toBeCloseTo(6);
    expect(enclosedMm3(cube)).toBeCloseTo(1);
  });
});
