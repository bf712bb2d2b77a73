/** The frames of the simulation on the mesh that is shown. They stand outside the signals, which hold their times only. */
import { computed, signal } from '@preact/signals';
import {
  noValue,
  promisedStages,
  type FieldInfo,
  type FoundFields,
  type Frame,
  type Physics,
  type Report,
  type Simulated,
  type SimulationName,
  type Traces,
} from '../../engine/contract';
import { time } from '../view';
import { FrameRing } from './frame_ring';

const maxBytes = 256 * 2 ** 20;

export type SimulationState = 'none' | 'running' | 'paused' | 'done' | 'cancelled' | 'failed';

/** How the simulation stands that the frames are of, and the time that it is to reach, ms. */
export const simulation = signal<SimulationState>('none');
export const simulationEndMs = signal(0);
/** The part of it that is done. */
export const simulationPart = signal(0);
/** It runs, and has not given a frame yet: those at hand are of an earlier run. */
export const awaitsFrames = signal(false);
export const simulationOf = signal<SimulationName | null>(null);

let ring = new FrameRing(maxBytes);

/** What the frames had recorded so far, of all of them: none of it is dropped. */
export const tracesSoFar = signal<Traces | null>(null);

/** A run that goes on from an earlier time tells what comes after it anew. */
function addTraces({ times_ms, lines }: Traces): void {
  const known = tracesSoFar.peek();
  const stays = known?.times_ms.filter((time) => time < times_ms[0]).length ?? 0;
  const grown = (before: number[] | undefined, more: number[]) => [
    ...(before?.slice(0, stays) ?? []),
    ...more,
  ];
  tracesSoFar.value = {
    times_ms: grown(known?.times_ms, times_ms),
    lines: lines.map((line, i) => ({ ...line, values: grown(known?.lines[i].values, line.values) })),
  };
}

/** Times of the frames at hand, ms, ascending. */
export const frameTimes = signal<readonly number[]>([]);

/** What the frames show; the range is that of all frames so far, so that a colour means the same in each. */
export interface PlayedField {
  info: FieldInfo;
  range: [number, number];
  /** Where a few elements are far beyond the others: the range of the others. */
  most?: [number, number];
}

/** A wave is being computed, or is held, and has begun: it can be given another stimulus. */
export const mayStimulate = computed(
  () =>
    simulationOf.value === 'monodomain' &&
    (simulation.value === 'running' || simulation.value === 'paused') &&
    frameTimes.value.length > 0,
);

export const playedFields = signal<readonly PlayedField[]>([]);

/** What simulations of this mesh have found at their ends, by the name of the field. */
const found = new Map<string, Float32Array>();
export const foundFields = signal<readonly PlayedField[]>([]);

/** The field of another beat: `activation_ms`, `activation_2_ms`, `activation_3_ms` ... */
export const ofBeat = (name: string, beat: number): string =>
  name.replace(/(_\d+)?_ms$/, beat > 1 ? `_${beat}_ms` : '_ms');

/** Fields of the same names, of an earlier simulation, give way, and with those of the first beat the later ones. */
export function keepFound({ fields, values }: FoundFields): void {
  const fresh = fields
    .filter(({ name }) => !playedFields.peek().some(({ info }) => info.name === name))
    .map((info): PlayedField => ({ info, range: info.range ?? [0, 1] }));
  const names = new Set(fresh.map(({ info }) => info.name));
  const stays = (name: string) => !names.has(name) && !names.has(ofBeat(name, 1));
  for (const name of found.keys()) if (!stays(name)) found.delete(name);
  for (const name of names) found.set(name, values[name]);
  foundFields.value = [...foundFields.peek().filter(({ info }) => stays(info.name)), ...fresh];
}

/** The report of the mesh with what simulations of it have found. */
export const simulationReport = signal<Report | null>(null);

/** The figures of the simulations of this mesh. */
export const simulated = computed<Simulated>(() => simulationReport.value?.simulation ?? {});

/** Digests of what they found, and the version of the physics that found it. */
export interface SimulationDigests {
  physics: string;
  stages: Partial<Record<(typeof promisedStages)[number], string>>;
}

export const simulationDigests = computed<SimulationDigests | null>(() => {
  const { physics, stages } = simulationReport.value ?? {};
  if (!physics || !stages) return null;
  const digests = promisedStages.flatMap((name) => {
    // The names of a report's stages are those of simulations too.
    const done = stages.find((stage) => (stage.name as string) === name);
    return done ? [[name, done.digest]] : [];
  });
  return { physics, stages: Object.fromEntries(digests) };
});

/** The physics that this is of, with what was given to a wave on its way. */
export const foundPhysics = computed<Physics | null>(() => simulationReport.value?.recipe.physics ?? null);

/** What the last of them was asked, with what it was given on its way. */
export const simulatedPhysics = signal<Physics | null>(null);

/** Of another mesh, or of none. */
export function forgetFound(): void {
  simulatedPhysics.value = null;
  simulationReport.value = null;
  found.clear();
  foundFields.value = [];
}

export const foundValues = (name: string): Float32Array | undefined => found.get(name);

/** The frames and what was found, as they stand, for whoever goes on when this page has forgotten them. */
export interface KeptSimulation {
  frames: Pick<FrameRing, 'at'>;
  found: ReadonlyMap<string, Float32Array>;
}

export function keptSimulation(): KeptSimulation {
  return { frames: ring, found: new Map(found) };
}

/** Whether a point has a value. */
export const hasValue = (value: number): boolean => value > noValue / 2;

/** What the frames at hand are of. */
export const framesOf = signal<SimulationName | null>(null);

function clearFrames(): void {
  ring = new FrameRing(maxBytes);
  framesOf.value = null;
  frameTimes.value = [];
  playedFields.value = [];
  tracesSoFar.value = null;
  time.value = 0;
}

export function forgetFrames(): void {
  clearFrames();
  complete.clear();
  simulation.value = 'none';
}

/** Before the first frame of a run: one that goes on from an earlier time of the same simulation keeps what was before. */
export function beginFrames(name: SimulationName, timeMs: number): void {
  complete.delete(name);
  const goesOn = framesOf.peek() === name && ring.times.some((known) => known < timeMs);
  if (goesOn) ring = ring.before(timeMs);
  else clearFrames();
  framesOf.value = name;
  frameTimes.value = ring.times;
}

/** Frames of simulations that are done, with the key of the result: the engine gives none of what it has at hand. */
const complete = new Map<
  SimulationName,
  { key: string; ring: FrameRing; fields: readonly PlayedField[]; traces: Traces | null }
>();

/** There will be no more frames of this simulation. */
export function endFrames(name: SimulationName, key: string): void {
  complete.set(name, { key, ring, fields: playedFields.peek(), traces: tracesSoFar.peek() });
}

/** Shows the frames of a result that was at hand. Where they are gone there are none: others would say something else. */
export function showFrames(name: SimulationName, key: string): void {
  const known = complete.get(name);
  if (known?.key !== key) return forgetFrames();
  if (framesOf.peek() === name) return;
  clearFrames();
  ({ ring } = known);
  framesOf.value = name;
  playedFields.value = known.fields;
  tracesSoFar.value = known.traces;
  frameTimes.value = ring.times;
}

export function keepFrame(frame: Frame): void {
  ring.push(frame);
  const known = playedFields.peek();
  const grown = frame.fields.map((info) => {
    const before = known.find((one) => one.info.name === info.name);
    const most = info.unit === '%' ? mostOf(frame.values[info.name]) : null;
    const isKnown = before && within(info.range, before.range) && within(most, before.most ?? before.range);
    return isKnown ? before : grownBy(before, info, most);
  });
  if (grown.some((field, i) => field !== known[i])) playedFields.value = grown;
  if (frame.traces) addTraces(frame.traces);
  frameTimes.value = ring.times;
}

type Range = [number, number];

const within = (inner: Range | null, [lo, hi]: Range): boolean =>
  !inner || (inner[0] >= lo && inner[1] <= hi);

const around = (one: Range, other: Range | undefined): Range =>
  other ? [Math.min(one[0], other[0]), Math.max(one[1], other[1])] : one;

function grownBy(before: PlayedField | undefined, info: FieldInfo, most: Range | null): PlayedField {
  const range = around(info.range ?? [0, 1], before?.range);
  return { info, range, ...(most && { most: around(most, before?.most) }) };
}

/** Of so many elements, spread over all, the ends are taken. */
const sampled = 5000;

/** The range of all but a hundredth at either end. */
function mostOf(values: Float32Array): Range | null {
  const step = Math.ceil(values.length / sampled);
  const some = values.filter((value, i) => i % step === 0 && hasValue(value)).sort();
  const end = Math.floor(some.length / 100);
  return some.length > 0 ? [some[end], some[some.length - 1 - end]] : null;
}

/** The last frame that is not after a time, or the first. Reading subscribes to which frames there are. */
export function frameAt(timeMs: number): Frame | null {
  return frameTimes.value.length > 0 ? ring.at(timeMs) : null;
}

/** The frame at the time cursor. */
export const frameShown = computed(() => frameAt(time.value));
