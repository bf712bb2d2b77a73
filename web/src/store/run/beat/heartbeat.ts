/** The heart's beat that is shown, as it comes or as it was found, and runs that later ones are held against. */
import { computed, signal } from '@preact/signals';
import type { Simulated, Traces, Ventricle, VentricleBeat } from '../../../engine/contract';
import { frameTimes, framesOf, simulated, simulatedPhysics, simulation, tracesSoFar } from '../frames';

/** Whether the frames at hand are the heart's: the time cursor is then one of its times. */
export const heartIsPlayed = computed(() => framesOf.value === 'mechanics' && frameTimes.value.length > 0);

/** All that was recorded: of the run under way what there is so far, else of the last that was done. */
export const heartTraces = computed<Traces | null>(() =>
  framesOf.value === 'mechanics' ? tracesSoFar.value : (simulated.value.mechanics?.traces ?? null),
);

/** The length of a beat of these, ms. */
export const heartPeriodMs = computed(() => simulatedPhysics.value?.mechanics?.period_ms ?? Infinity);

/** What was found at the end of the run whose traces are shown; null where it has not come there. */
export const heartFound = computed<NonNullable<Simulated['mechanics']> | null>(() => {
  const underWay = framesOf.value === 'mechanics' && simulation.value !== 'done';
  return underWay ? null : (simulated.value.mechanics ?? null);
});

export interface KeptBeat {
  id: number;
  name: string;
  periodMs: number;
  traces: Traces;
  last: Record<Ventricle, VentricleBeat>;
}

/** Kept for as long as the page is open. */
export const keptBeats = signal<readonly KeptBeat[]>([]);
let count = 0;

export function keepBeat(name: string): void {
  const found = heartFound.value;
  const last = found?.beats.at(-1);
  if (!found || !last) return;
  count++;
  const kept = { id: count, name: name.trim() || `Run ${count}`, periodMs: heartPeriodMs.value };
  keptBeats.value = [...keptBeats.value, { ...kept, traces: found.traces, last }];
}

export function renameBeat(id: number, name: string): void {
  keptBeats.value = keptBeats.value.map((one) => (one.id === id ? { ...one, name } : one));
}

export function dropBeat(id: number): void {
  keptBeats.value = keptBeats.value.filter((one) => one.id !== id);
}
