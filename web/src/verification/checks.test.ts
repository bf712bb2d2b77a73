import { beforeEach, expect, test } from 'vitest';
import { checks, failure, groups, measuredText, start, state, summary, take, type Check } from './checks';

const line = (more: Partial<Check>): string =>
  JSON.stringify({
    check: 'Fibres',
    case: 'mean error',
    measured: 0.4123,
    unit: 'degrees',
    expected: 'below 3',
    source: 'closed form',
    agrees: true,
    ...more,
  });

beforeEach(() => {
  checks.value = [];
  state.value = 'idle';
});

test('lines become rows of their group, in their order', () => {
  take({ line: line({}) });
  take({ line: line({ check: 'Slab', case: 'corner', agrees: false }) });
  take({ line: line({ case: 'p95' }) });
  expect(groups.value.map(([title, found]) => [title, found.map((one) => one.case)])).toEqual([
    ['Fibres', ['mean error', 'p95']],
    ['Slab', ['corner']],
  ]);
  expect(summary(checks.value)).toBe('2 of 3 agree');
});

test('a run ends with its worker, and says why it failed', () => {
  const sent: unknown[] = [];
  let ended = 0;
  const worker = {
    onmessage: null as Worker['onmessage'],
    onerror: null as Worker['onerror'],
    postMessage: (message: unknown) => void sent.push(message),
    terminate: () => void ended++,
  };
  Object.assign(globalThis, { document: { baseURI: 'https://host/page/' } });
  start(worker as never);
  expect(sent).toEqual(['https://host/page/engine/voxtet_verification.mjs']);
  worker.onmessage?.call(worker as never, { data: { line: line({}) } } as never);
  expect([state.value, ended]).toEqual(['running', 0]);
  worker.onmessage?.call(worker as never, { data: { failed: 'out of memory' } } as never);
  expect([state.value, failure.value, ended]).toEqual(['failed', 'out of memory', 1]);
});

test('numbers have the digits that their size asks for', () => {
  const text = (measured: number, unit: string) => measuredText({ measured, unit } as Check);
  expect(text(82.4712, 'ms')).toBe('82.47 ms');
  expect(text(0.49971, 'mm/ms')).toBe('0.500 mm/ms');
  expect(text(2.2e-16, '')).toBe('2.2e-16');
});
