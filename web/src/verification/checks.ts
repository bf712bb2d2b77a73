/** The checks that the engine's program of verification makes, a line of JSON each, and how a run of them stands. */
import { computed, signal } from '@preact/signals';

export interface Check {
  check: string;
  case: string;
  measured: number;
  unit: string;
  expected: string;
  source: string;
  agrees: boolean;
}

export type Message = { line: string } | { done: true } | { failed: string };

export const checks = signal<readonly Check[]>([]);
export const state = signal<'idle' | 'running' | 'done' | 'failed'>('idle');
export const failure = signal('');
export const seconds = signal(0);

/** The checks by their titles, in the order in which they came. */
export const groups = computed(() => {
  const found = new Map<string, Check[]>();
  for (const one of checks.value) found.set(one.check, [...(found.get(one.check) ?? []), one]);
  return [...found];
});

/** Tells what a worker says; a worker that ends without a word of its own has failed. */
export function take(message: Message): void {
  if ('line' in message) checks.value = [...checks.value, JSON.parse(message.line) as Check];
  else if ('failed' in message) {
    failure.value = message.failed;
    state.value = 'failed';
  } else state.value = 'done';
}

export function start(worker: Pick<Worker, 'postMessage' | 'onmessage' | 'onerror' | 'terminate'>): void {
  checks.value = [];
  failure.value = '';
  state.value = 'running';
  const began = performance.now();
  const end = (message: Message) => {
    take(message);
    seconds.value = (performance.now() - began) / 1000;
    if (state.value !== 'running') worker.terminate();
  };
  worker.onmessage = ({ data }: MessageEvent<Message>) => end(data);
  worker.onerror = ({ message }) => end({ failed: message || 'the program could not be started' });
  const folder = import.meta.env.VITE_ENGINE ?? 'engine/';
  worker.postMessage(new URL(`${folder}voxtet_verification.mjs`, document.baseURI).href);
}

/** As many digits as tell the value from what is expected. */
export function measuredText({ measured, unit }: Check): string {
  const digits = Math.abs(measured) >= 10 ? 2 : Math.abs(measured) >= 0.1 ? 3 : undefined;
  const number = digits === undefined ? measured.toPrecision(2) : measured.toFixed(digits);
  return `${number} ${unit}`.trim();
}

export function summary(found: readonly Check[]): string {
  const agreeing = found.filter(({ agrees }) => agrees).length;
  return `${agreeing} of ${found.length} agree`;
}
