/** How long a run has taken. */
import { signal } from '@preact/signals';

export const elapsedSeconds = signal(0);

let clock: ReturnType<typeof setInterval> | undefined;

export function startClock(): void {
  const begin = performance.now();
  elapsedSeconds.value = 0;
  stopClock();
  clock = setInterval(() => (elapsedSeconds.value = (performance.now() - begin) / 1000), 100);
}

export function stopClock(): void {
  clearInterval(clock);
}
