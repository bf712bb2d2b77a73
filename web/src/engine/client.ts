import * as Comlink from 'comlink';
import {
  EngineError,
  stageNames,
  type EngineApi,
  type EngineInfo,
  type ErrorCode,
  type ExportedFile,
  type ExportFormat,
  type Recipe,
  type Reply,
  type Report,
  type SideKind,
  type SideSummary,
  type Space,
  type StageArrays,
  type StageName,
  type StageSummary,
  type VolumeFile,
  type VolumeSummary,
} from './contract';

/** The part of a Worker that the client needs; tests give it a message port. */
export interface WorkerLike extends Comlink.Endpoint {
  terminate(): void;
}

export interface EngineSetup {
  spawn(): WorkerLike;
  compile(): Promise<WebAssembly.Module>;
  scriptUrl: string;
  /** Calls back once a worker that holds this lock is gone. */
  whenReleased(lock: string, callback: () => void): void;
}

export interface RunHandlers {
  onProgress?(stage: StageName, fraction: number): void;
  /** Whether the arrays of a stage that is done are to be copied out of the engine; else they are. */
  wants?(summary: StageSummary): boolean;
  /** A stage is done; nothing is handed over that was not wanted. */
  onStage?(summary: StageSummary, arrays: Partial<StageArrays[StageName]> | null): void;
}

export interface RecipeReply {
  recipe: Recipe;
  minimal: Record<string, unknown>;
}

/** One worker's life, from spawn to terminate. */
interface Generation {
  worker: WorkerLike;
  api: Comlink.Remote<EngineApi>;
  started: Promise<EngineInfo>;
  ended: Promise<never>;
  /** Told when the worker ends before it has answered. */
  waiting: Set<(error: EngineError) => void>;
  end(error: EngineError): void;
  alive: boolean;
  /** Digest of the file volume that this worker holds. */
  volume: string | null;
  /** What it holds of each kind beside it, by name. */
  sides: Map<string, VolumeFile>;
}

const sideKey = (kind: SideKind, name: string): string => `${kind} ${name}`;

function failure(code: ErrorCode, message: string, stage = 'engine'): EngineError {
  return new EngineError({ code, stage, message });
}

const cancelled = () => failure('cancelled', 'The run was cancelled.');

/**
 * The engine behind typed promises. Jobs run one at a time in a disposable worker: cancelling, or starting a job
 * that supersedes another, ends the worker and goes on in a spare one, made from the compiled module. The bytes of opened
 * files stay here, so a new worker gets them again and nothing that the user did is lost.
 */
export class EngineClient {
  private readonly setup: EngineSetup;
  private module: Promise<WebAssembly.Module> | undefined;
  private generation: Generation;
  /** Started with the first job, so that whoever cancels one finds the next engine ready. */
  private spare: Generation | null = null;
  private readonly volumes = new Map<string, VolumeFile>();
  private readonly sides = new Map<string, VolumeFile>();
  private tail: Promise<unknown> = Promise.resolve();
  private runningJobs = 0;
  private generationCount = 0;

  constructor(setup: EngineSetup) {
    this.setup = setup;
    this.generation = this.spawn();
  }

  /** Schema and defaults, once an engine is up. */
  get ready(): Promise<EngineInfo> {
    return this.generation.started;
  }

  get busy(): boolean {
    return this.runningJobs > 0;
  }

  /** Reads a label volume. On failure the earlier volumes stay. */
  openVolume(file: VolumeFile): Promise<VolumeSummary> {
    return this.job(async (generation) => {
      generation.volume = null;
      const summary = await this.answer(generation, 'volume', generation.api.loadVolume(file));
      generation.volume = summary.digest;
      this.volumes.set(summary.digest, file);
      return summary;
    });
  }

  /** The bytes of a volume that has been opened. */
  volumeFile(digest: string): VolumeFile | undefined {
    return this.volumes.get(digest);
  }

  /** Takes bytes that an earlier session opened; they are read when a case needs them. */
  keepVolume(digest: string, file: VolumeFile): void {
    this.volumes.set(digest, file);
  }

  /** Reads a mask or an image of sizes, which must have a digest if one is given. One of the same name is replaced. */
  openSideVolume(kind: SideKind, file: VolumeFile, digest = ''): Promise<SideSummary> {
    return this.job(async (generation) => {
      const key = sideKey(kind, file.name);
      generation.sides.delete(key);
      const found = await this.answer(generation, 'sizing', generation.api.loadSideVolume(kind, file));
      if (digest !== '' && digest !== found.digest) {
        const heads = [found.digest, digest].map((one) => `${one.slice(0, 12)}…`);
        const message = `${file.name} has the digest ${heads[0]}, the case was made with ${heads[1]}`;
        throw failure('differs', message, 'sizing');
      }
      generation.sides.set(key, file);
      this.sides.set(key, file);
      return found;
    });
  }

  /** The file of a mask or an image of sizes. */
  sideFile(kind: SideKind, name: string): VolumeFile | undefined {
    return this.sides.get(sideKey(kind, name));
  }

  /** Takes such a file unread: one of an earlier session, or one that the page itself has made. */
  keepSideVolume(kind: SideKind, file: VolumeFile): void {
    this.sides.set(sideKey(kind, file.name), file);
  }

  forgetSideVolumes(): void {
    this.sides.clear();
  }

  /** Whether the engine accepts a case; the reply names every field. The case's volume need not be there. */
  checkRecipe(value: object): Promise<RecipeReply> {
    return this.job(async (generation) => {
      const { file } = (value as { source?: { file?: unknown } }).source ?? {};
      const digest = (file as { sha256?: unknown } | undefined)?.sha256;
      if (digest === undefined) {
        return this.answer(generation, 'recipe', generation.api.setRecipe(JSON.stringify(value)));
      }
      if (typeof digest !== 'string' || !/^([0-9a-f]{64})?$/.test(digest)) {
        throw failure('usage', 'source.file.sha256: expected 64 hexadecimal digits', 'recipe');
      }
      // With its digest, the engine would hold the case against the volume that is loaded now.
      const loose = {
        ...value,
        source: { ...(value as Recipe).source, file: { ...(file as object), sha256: '' } },
      };
      const reply = await this.answer(generation, 'recipe', generation.api.setRecipe(JSON.stringify(loose)));
      for (const half of [reply.recipe, reply.minimal] as { source: { file: object } }[]) {
        half.source = { file: { ...half.source.file, sha256: digest } };
      }
      return reply;
    });
  }

  /** Runs stage by stage up to `last`, so that each result is there as soon as it exists. */
  run(recipeJson: string, source: Recipe['source'], last: StageName, handlers: RunHandlers = {}) {
    return this.job(async (generation) => {
      const accepted = await this.prepare(generation, recipeJson, source);
      let running: StageName | null = null;
      // It comes by a port of its own: at times after the answer of its stage.
      const progress = Comlink.proxy((stage: StageName, fraction: number) => {
        if (generation.alive && stage === running) handlers.onProgress?.(stage, fraction);
      });
      const summaries: StageSummary[] = [];
      for (const stage of stageNames.slice(0, stageNames.indexOf(last) + 1)) {
        handlers.onProgress?.(stage, 0);
        running = stage;
        const summary = await this.answer(generation, stage, generation.api.run(stage, progress));
        running = null;
        summaries.push(summary);
        const wanted = handlers.wants?.(summary) ?? true;
        const arrays = wanted ? await this.answer(generation, stage, generation.api.arrays(stage)) : null;
        handlers.onStage?.(summary, arrays);
      }
      const report =
        last === 'quality' ? await this.answer(generation, 'quality', generation.api.report()) : undefined;
      return { ...accepted, summaries, report } as RecipeReply & {
        summaries: StageSummary[];
        report?: Report;
      };
    });
  }

  /** What meshing will take; with `elements` above 0 also the sizes that give so many. `signal` calls it off. */
  forecast(recipeJson: string, source: Recipe['source'], elements = 0, signal?: AbortSignal) {
    return this.job(async (generation) => {
      if (signal?.aborted) throw cancelled();
      const end = () => generation.alive && this.replace(cancelled());
      signal?.addEventListener('abort', end);
      try {
        await this.prepare(generation, recipeJson, source);
        return await this.answer(generation, 'forecast', generation.api.forecast(elements));
      } finally {
        signal?.removeEventListener('abort', end);
      }
    });
  }

  /** Files of the mesh of this recipe; stages that the worker no longer holds run again. */
  exportMesh(
    recipeJson: string,
    source: Recipe['source'],
    format: ExportFormat,
    space: Space,
    name: string,
    handlers: RunHandlers = {},
  ): Promise<ExportedFile[]> {
    return this.job(async (generation) => {
      await this.prepare(generation, recipeJson, source);
      const progress = Comlink.proxy((stage: StageName, fraction: number) =>
        handlers.onProgress?.(stage, fraction),
      );
      await this.answer(generation, 'optimise', generation.api.run('quality', progress));
      return this.answer(generation, 'export', generation.api.exportMesh(format, space, name));
    });
  }

  /** Ends whatever runs. Resolves when the next engine answers, with the milliseconds that took. */
  async cancel(): Promise<number> {
    const begin = performance.now();
    this.replace(cancelled());
    await this.generation.started;
    return performance.now() - begin;
  }

  private async prepare(generation: Generation, recipeJson: string, source: Recipe['source']) {
    const digest = source.file?.sha256;
    if (digest && generation.volume !== digest) {
      const file = this.volumes.get(digest);
      if (!file) {
        throw failure(
          'usage',
          `Drop the file ${source.file?.name} first: this case was made from it.`,
          'volume',
        );
      }
      await this.answer(generation, 'volume', generation.api.loadVolume(file));
      generation.volume = digest;
    }
    const accepted = await this.answer(generation, 'recipe', generation.api.setRecipe(recipeJson));
    const { masks, images } = accepted.recipe.sizing;
    for (const { name } of masks) await this.loadSide(generation, 'mask', name);
    for (const { name } of images) await this.loadSide(generation, 'image', name);
    return accepted;
  }

  /** A file that is not there is the engine's to miss, once its stage comes. */
  private async loadSide(generation: Generation, kind: SideKind, name: string): Promise<void> {
    const key = sideKey(kind, name);
    const file = this.sides.get(key);
    if (!file || generation.sides.get(key) === file) return;
    await this.answer(generation, 'sizing', generation.api.loadSideVolume(kind, file));
    generation.sides.set(key, file);
  }

  private job<T>(body: (generation: Generation) => Promise<T>): Promise<T> {
    const turn = this.tail.then(async () => {
      if (!this.generation.alive) this.generation = this.spawn();
      const generation = this.generation;
      this.runningJobs++;
      try {
        await this.unlessEnded(generation, generation.started);
        this.spare ??= this.spawn();
        return await body(generation);
      } finally {
        this.runningJobs--;
      }
    });
    this.tail = turn.catch(() => undefined);
    return turn;
  }

  /** The value of a reply, or its typed error; an engine that cannot go on is replaced at once. */
  private async answer<T>(generation: Generation, stage: string, call: Promise<Reply<T>>): Promise<T> {
    let reply: Reply<T>;
    try {
      reply = await this.unlessEnded(generation, call);
    } catch (error) {
      if (error instanceof EngineError) throw error;
      const lost = failure('internal', `The engine stopped unexpectedly (${String(error)}).`, stage);
      if (generation.alive) this.replace(lost);
      throw lost;
    }
    if (reply.ok) return reply.value;
    const error = new EngineError(reply.error);
    if (reply.error.fatal && generation.alive) this.replace(error);
    throw error;
  }

  /** What a call gives, or why its worker has ended. A race with `ended` would stay with it for the worker's whole life. */
  private unlessEnded<T>(generation: Generation, call: Promise<T>): Promise<T> {
    return new Promise((done, failed) => {
      if (!generation.alive) return void generation.ended.catch(failed);
      generation.waiting.add(failed);
      void call.then(done, failed).then(() => generation.waiting.delete(failed));
    });
  }

  private compiled(): Promise<WebAssembly.Module> {
    if (!this.module) {
      this.module = this.setup.compile();
      this.module.catch(() => (this.module = undefined));
    }
    return this.module;
  }

  private replace(reason: EngineError): void {
    const old = this.generation;
    old.end(reason);
    old.worker.terminate();
    this.generation = this.spare?.alive ? this.spare : this.spawn();
    this.spare = null;
  }

  private spawn(): Generation {
    const worker = this.setup.spawn();
    const api = Comlink.wrap<EngineApi>(worker);
    const lock = `voxtet-engine-${++this.generationCount}-${Math.random().toString(36).slice(2)}`;
    let reject: (error: EngineError) => void = () => undefined;
    const ended = new Promise<never>((_, fail) => (reject = fail));
    ended.catch(() => undefined);
    const started = this.compiled().then((module) =>
      Promise.race([api.start(module, this.setup.scriptUrl, lock), ended]),
    );
    const generation: Generation = {
      worker,
      api,
      started,
      ended,
      waiting: new Set(),
      alive: true,
      volume: null,
      sides: new Map(),
      end(error) {
        generation.alive = false;
        reject(error);
        for (const failed of generation.waiting) failed(error);
        generation.waiting.clear();
      },
    };
    let hasStarted = false;
    // A worker that fails before it has started would fail again at once: the next job tries anew.
    const died = (message: string) => {
      if (!generation.alive) return;
      if (generation === this.spare) {
        this.spare = null;
        generation.end(failure('internal', message));
      } else if (hasStarted) this.replace(failure('internal', message));
      else generation.end(failure('internal', message));
    };
    worker.addEventListener('error', (event) => {
      const detail = (event as ErrorEvent).message;
      died(`The engine's worker failed${detail ? `: ${detail}` : ''}.`);
    });
    started.then(
      () => {
        hasStarted = true;
        this.setup.whenReleased(lock, () =>
          died('The engine was ended by the browser; your inputs are kept.'),
        );
      },
      (error: unknown) => {
        if (generation.alive)
          generation.end(failure('internal', `The engine could not be loaded (${String(error)}).`));
      },
    );
    return generation;
  }
}
