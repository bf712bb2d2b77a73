/** Runs of the engine in parts: between two of them the worker hears what else is wanted. */
import { withNone, withRoom } from '../geometry/rows';
import { guarded } from './failures';
import { noValue, type FieldInfo, type Frame, type Reply, type Traces } from './contract';
import type { Session } from './session_api';

interface Part<Summary> {
  done: boolean;
  stage: string;
  fraction: number;
  summary?: Summary;
}

/** What the engine may work on before it hears what else is wanted; stages that cannot be cut take longer. */
const budgetMs = 50;

/** Messages closer together than this tell a person nothing. */
const progressIntervalMs = 40;

/** Lets the messages that have come in be heard. */
function nextMessage(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}

/** What the engine says of a frame. */
export interface Snapshot {
  time_ms: number;
  fields: FieldInfo[];
  trace_times_ms: number[];
  traces: Traces['lines'];
}

/** The length of each vector of three numbers, and the least and the most of them. */
function lengthsOf(vectors: Float32Array): { lengths: Float32Array; range: [number, number] } {
  const lengths = new Float32Array(vectors.length / 3);
  const range: [number, number] = [Infinity, -Infinity];
  for (let i = 0; i < lengths.length; i++) {
    lengths[i] = Math.hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]);
    range[0] = Math.min(range[0], lengths[i]);
    range[1] = Math.max(range[1], lengths[i]);
  }
  return { lengths, range };
}

/** The frame that the engine has just told of, with its values. */
export function frameOf(session: Session, told: Snapshot): Frame {
  const frame: Frame = { timeMs: told.time_ms, fields: [], values: {} };
  for (const field of told.fields) {
    const view = session.snapshotArray(field.name) as Float32Array | undefined;
    if (!view) continue;
    if (field.components === 3) {
      const { lengths, range } = lengthsOf(view);
      frame.moves = view.slice();
      frame.fields.push({ ...field, components: 1, range });
      frame.values[field.name] = withRoom(lengths as Float32Array<ArrayBuffer>);
    } else {
      frame.fields.push(field);
      frame.values[field.name] = withRoom(withNone(view, noValue));
    }
  }
  if (told.traces.length > 0) frame.traces = { times_ms: told.trace_times_ms, lines: told.traces };
  return frame;
}

/** The frames that have not been taken yet. */
function takeFrames(session: Session): Frame[] {
  const frames: Frame[] = [];
  for (;;) {
    const { value } = JSON.parse(session.takeSnapshot()) as { value: Snapshot | null };
    if (!value) return frames;
    frames.push(frameOf(session, value));
  }
}

export class PartedRuns {
  private readonly session: Session;
  private paused = false;
  private ended = false;
  private heard: () => void = () => undefined;

  constructor(session: Session) {
    this.session = session;
  }

  /** Runs up to a stage. `onFrame` is waited for, so that frames do not pile up before whoever shows them. */
  async run<Summary>(
    stage: string,
    onProgress: (stage: string, fraction: number) => void,
    onFrame?: (frame: Frame) => Promise<void>,
  ): Promise<Reply<Summary>> {
    this.paused = this.ended = false;
    const tell = rarely(stage, onProgress);
    const begun = guarded(stage, () => JSON.parse(this.session.begin(stage)) as Reply<null>);
    if (!begun.ok) return begun;
    for (;;) {
      const part = guarded(
        stage,
        () => JSON.parse(this.session.advance(budgetMs, tell)) as Reply<Part<Summary>>,
      );
      if (!part.ok) return part;
      if (onFrame) await Promise.all(takeFrames(this.session).map(onFrame));
      if (part.value.summary) return { ok: true, value: part.value.summary };
      await nextMessage();
      while (this.paused && !this.ended) await new Promise<void>((resolve) => (this.heard = resolve));
      if (!this.ended) continue;
      this.session.end();
      return { ok: false, error: { code: 'cancelled', stage, message: 'The run was cancelled.' } };
    }
  }

  pause(paused: boolean): void {
    this.paused = paused;
    this.heard();
  }

  end(): void {
    this.ended = true;
    this.heard();
  }
}

/** Passes on a new stage and the end of one, and of the rest what a person can follow. */
function rarely(first: string, onProgress: (stage: string, fraction: number) => void): typeof onProgress {
  let current = first;
  let lastTime = 0;
  return (stage, fraction) => {
    const now = performance.now();
    if (stage === current && fraction < 1 && now - lastTime < progressIntervalMs) return;
    current = stage;
    lastTime = now;
    onProgress(stage, fraction);
  };
}
