/** Plays the frames: moves the time cursor. */
import { effect, signal } from '@preact/signals';
import { time } from '../view';
import { frameTimes, framesOf, simulation } from './frames';

/** While a simulation goes on, playing shows its newest frame; else the cursor goes over all of them. */
export const playing = signal(false);

/** From the first frame to the last. */
const playMs = 6000;

const newest = (): number => frameTimes.peek().at(-1) ?? 0;
const computing = (): boolean => simulation.value === 'running';

export function play(): void {
  if (frameTimes.peek().length < 2 && !computing()) return;
  if (!computing() && time.peek() >= newest()) time.value = frameTimes.peek()[0];
  playing.value = true;
}

export function stopPlaying(): void {
  playing.value = false;
}

export function togglePlaying(): void {
  (playing.peek() ? stopPlaying : play)();
}

/** The next frame, or the one before. */
export function stepFrame(way: 1 | -1): void {
  stopPlaying();
  const times = frameTimes.peek();
  const now = time.peek();
  const next = way > 0 ? times.find((one) => one > now) : times.filter((one) => one < now).at(-1);
  if (next !== undefined) time.value = next;
}

export function seek(timeMs: number): void {
  stopPlaying();
  time.value = Math.max(0, Math.min(newest(), timeMs));
}

/** Moves the cursor for as long as frames are played, until what it gives is called. */
export function keepPlaying(): () => void {
  return effect(() => {
    if (!playing.value) return;
    if (computing()) {
      const last = frameTimes.value.at(-1);
      if (last !== undefined) time.value = last;
      return;
    }
    let before: number | null = null;
    let asked = requestAnimationFrame(function turn(now) {
      const end = newest();
      const span = end - (frameTimes.peek()[0] ?? 0);
      time.value = Math.min(end, time.peek() + (span * (now - (before ?? now))) / playMs);
      const over = time.peek() >= end;
      // A heart beats on, but not by itself once it has been computed.
      const again = over && before !== null && framesOf.peek() === 'mechanics';
      before = now;
      if (again) time.value = frameTimes.peek()[0];
      if (over && !again) stopPlaying();
      else asked = requestAnimationFrame(turn);
    });
    return () => cancelAnimationFrame(asked);
  });
}
