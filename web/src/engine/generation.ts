import * as Comlink from 'comlink';
import {
  EngineError,
  type EngineApi,
  type EngineInfo,
  type EngineScripts,
  type ErrorCode,
  type VolumeFile,
} from './contract';

/** The part of a Worker that the client needs; those of node and of tests are made to look like it. */
export interface WorkerLike extends Comlink.Endpoint {
  terminate(): void;
}

export interface EngineSetup {
  spawn(): WorkerLike;
  compile(): Promise<WebAssembly.Module>;
  scripts: EngineScripts;
  /** Calls back once a worker that holds this lock is gone. */
  whenReleased(lock: string, callback: () => void): void;
}

/** A mask or an image of sizes, with the digest of its content. */
export interface Side {
  file: VolumeFile;
  digest: string;
}

/** One worker's life, from spawn to terminate. */
export interface Generation {
  worker: WorkerLike;
  api: Comlink.Remote<EngineApi>;
  started: Promise<EngineInfo>;
  ended: Promise<never>;
  /** Told when the worker ends before it has answered. */
  waiting: Set<(error: EngineError) => void>;
  end(error: EngineError): void;
  alive: boolean;
  /** Digest of the file volume that this worker holds, and how it was read. */
  volume: string | null;
  /** What it holds of each kind beside it, by name. */
  sides: Map<string, Side>;
  /** The simulation under way. */
  simulation: Promise<unknown> | null;
}

export function failure(code: ErrorCode, message: string, stage = 'engine'): EngineError {
  return new EngineError({ code, stage, message });
}

/** What a call gives, or why its worker has ended. A race with `ended` would stay with it for the worker's whole life. */
export function unlessEnded<T>(generation: Generation, call: Promise<T>): Promise<T> {
  return new Promise((done, failed) => {
    if (!generation.alive) return void generation.ended.catch(failed);
    generation.waiting.add(failed);
    void call.then(done, failed).then(() => generation.waiting.delete(failed));
  });
}

/** From asking a simulation to end until it is given up with its worker. */
const patienceMs = 1000;

/** Whether a simulation was under way and has ended by itself: its worker still holds the mesh. */
export function endSimulation({ simulation, api }: Generation): Promise<boolean> {
  if (!simulation) return Promise.resolve(false);
  void api.endSimulation();
  return new Promise((done) => {
    setTimeout(done, patienceMs, false);
    const ended = () => done(true);
    void simulation.then(ended, ended);
  });
}

/**
 * Spawns a worker and starts the engine in it. `lost` is called where the worker dies by itself; one that cannot be
 * started just ends.
 */
export function startGeneration(
  setup: EngineSetup,
  compiled: Promise<WebAssembly.Module>,
  lock: string,
  lost: (generation: Generation, reason: EngineError, hasStarted: boolean) => void,
): Generation {
  const worker = setup.spawn();
  const api = Comlink.wrap<EngineApi>(worker);
  let reject: (error: EngineError) => void = () => undefined;
  const ended = new Promise<never>((_, fail) => (reject = fail));
  ended.catch(() => undefined);
  const started = compiled.then((module) => Promise.race([api.start(module, setup.scripts, lock), ended]));
  const generation: Generation = {
    worker,
    api,
    started,
    ended,
    waiting: new Set(),
    alive: true,
    volume: null,
    sides: new Map(),
    simulation: null,
    end(error) {
      generation.alive = false;
      reject(error);
      for (const failed of generation.waiting) failed(error);
      generation.waiting.clear();
    },
  };
  let hasStarted = false;
  const died = (message: string) => {
    if (generation.alive) lost(generation, failure('internal', message), hasStarted);
  };
  worker.addEventListener('error', (event) => {
    const detail = (event as ErrorEvent).message;
    died(`The engine's worker failed${detail ? `: ${detail}` : ''}.`);
  });
  started.then(
    () => {
      hasStarted = true;
      setup.whenReleased(lock, () => died('The engine was ended by the browser; your inputs are kept.'));
    },
    (error: unknown) => {
      if (generation.alive)
        generation.end(failure('internal', `The engine could not be loaded (${String(error)}).`));
    },
  );
  return generation;
}
