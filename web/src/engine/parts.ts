/** Runs of the engine in parts: between two of them the worker hears what else is wanted. */
import { withNone, withRoom } from '../geometry/rows';
import { guarded } from './failures';
import { noValue, type FieldInfo, type Frame, type Reply } from './contract';
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
}

/** The frame that the engine has just told of, with its values. */
export function frameOf(session: Session, { time_ms, fields }: Snapshot): Frame {
  const values: Frame['values'] = {};
  for (const { name } of fields) {
    const view = session.snapshotArray(name);
    if (view) values[name] = withRoom(withNone(view as Float32Array, noValue));
  }
  return { timeMs: time_ms, fields, values };
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
