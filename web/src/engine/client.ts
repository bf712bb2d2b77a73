import * as Comlink from 'comlink';
import {
  EngineError,
  stageNames,
  stagesOfMesh,
  type EngineInfo,
  type ExportedFile,
  type ExportFormat,
  type FibreArrays,
  type FoundFields,
  type Frame,
  type Labels,
  type Recipe,
  type Reply,
  type Report,
  type SideKind,
  type SideSummary,
  type SimulationName,
  type SimulationSummary,
  type Space,
  type Stimulus,
  type StageName,
  type StageSummary,
  type VolumeFile,
  type VolumeSummary,
} from './contract';
import { withoutFileDigest } from './file_digest';
import {
  endSimulation,
  failure,
  startGeneration,
  unlessEnded,
  type EngineSetup,
  type Generation,
} from './generation';
import { OpenedFiles, readOptions, sideKey } from './opened_files';
import type { RecipeReply, RunHandlers, SimulationHandlers } from './handlers';

const cancelled = () => failure('cancelled', 'The run was cancelled.');

/**
 * The engine behind typed promises. Jobs run one at a time in a disposable worker: cancelling, or starting a job
 * that supersedes another, ends the worker and goes on in a spare one, made from the compiled module; a simulation ends
 * by itself, and its worker keeps the mesh. The bytes of opened files stay here, so a new worker gets them again and
 * nothing that the user did is lost.
 */
export class EngineClient {
  readonly files: OpenedFiles;
  private readonly setup: EngineSetup;
  private module: Promise<WebAssembly.Module> | undefined;
  private generation: Generation;
  /** Started with the first job, so that whoever cancels one finds the next engine ready. */
  private spare: Generation | null = null;
  private tail: Promise<unknown> = Promise.resolve();
  private runningJobs = 0;
  private generationCount = 0;
  private closed = false;

  constructor(setup: EngineSetup, files = new OpenedFiles()) {
    this.setup = setup;
    this.files = files;
    this.generation = this.spawn();
  }

  /** Schema and defaults, once an engine is up. */
  get ready(): Promise<EngineInfo> {
    return this.generation.started;
  }

  get busy(): boolean {
    return this.runningJobs > 0;
  }

  /** Reads a label volume, as the source of a recipe says, and gives its labels. On failure the earlier volumes stay. */
  openVolume(
    file: VolumeFile,
    source: Partial<Recipe['source']> = {},
    onLabels?: (labels: Labels) => void,
  ): Promise<VolumeSummary> {
    return this.job(async (generation) => {
      generation.volume = null;
      const options = readOptions(source);
      const summary = await this.answer(generation, 'volume', generation.api.loadVolume(file, options));
      generation.volume = summary.digest + options;
      this.files.keepVolume(summary.digest, file);
      if (onLabels) {
        const read = await this.answer(generation, 'volume', generation.api.arrays('volume'));
        if ('labels' in read) onLabels(read.labels as Labels);
      }
      return summary;
    });
  }

  /** The case with its label volume within it, so that whoever opens it needs no file. */
  inlineCase(recipeJson: string, source: Partial<Recipe['source']>) {
    return this.job(async (generation) => {
      await this.prepare(generation, recipeJson, source);
      return this.answer(generation, 'volume', generation.api.inlineCase());
    });
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
      generation.sides.set(key, this.files.keepSide(kind, file, found.digest));
      return found;
    });
  }

  /**
   * Whether the engine accepts a case; the reply names every field. The case's volume need not be there. The spare
   * worker answers where there is one: nothing has to wait for a mesh, nor end one, to learn whether a recipe is sound.
   */
  async checkRecipe(value: object): Promise<RecipeReply> {
    const { spare } = this;
    if (spare) {
      await unlessEnded(spare, spare.started).catch(() => undefined);
      // Once it has taken the place of another worker, its recipe is that of a job.
      if (spare === this.spare && spare.alive) return this.check(spare, value);
    }
    return this.job((generation) => this.check(generation, value));
  }

  private async check(generation: Generation, value: object): Promise<RecipeReply> {
    const [loose, putBack] = withoutFileDigest(value);
    return putBack(await this.answer(generation, 'recipe', generation.api.setRecipe(JSON.stringify(loose))));
  }

  /**
   * Runs stage by stage up to `last`, so that each result is there as soon as it exists. A mesh that was made elsewhere
   * is measured at once.
   */
  run(recipeJson: string, source: Partial<Recipe['source']>, last: StageName, handlers: RunHandlers = {}) {
    return this.job(async (generation) => {
      const accepted = await this.prepare(generation, recipeJson, source);
      let running: StageName | null = null;
      // It comes by a port of its own: at times after the answer of its stage.
      const progress = Comlink.proxy((stage: StageName, fraction: number) => {
        if (generation.alive && stage === running) handlers.onProgress?.(stage, fraction);
      });
      const summaries: StageSummary[] = [];
      let names: readonly StageName[] = stageNames.slice(0, stageNames.indexOf(last) + 1);
      for (let stage: StageName | undefined = names[0]; stage; stage = names[summaries.length]) {
        handlers.onProgress?.(stage, 0);
        running = stage;
        const summary = await this.answer(generation, stage, generation.api.run(stage, progress));
        running = null;
        summaries.push(summary);
        if (stage === 'volume' && summary.counts.mesh) names = stagesOfMesh;
        const wanted = handlers.wants?.(summary) ?? true;
        const arrays = wanted ? await this.answer(generation, stage, generation.api.arrays(stage)) : null;
        await handlers.onStage?.(summary, arrays);
      }
      const report =
        names.at(-1) === 'quality'
          ? await this.answer(generation, 'quality', generation.api.report())
          : undefined;
      if (report) this.files.meshedFrom(generation.sides);
      return { ...accepted, summaries, report } as RecipeReply & {
        summaries: StageSummary[];
        report?: Report;
      };
    }, handlers.signal);
  }

  /** What meshing will take; with `elements` above 0 also the sizes that give so many. `signal` calls it off. */
  forecast(recipeJson: string, source: Partial<Recipe['source']>, elements = 0, signal?: AbortSignal) {
    return this.job(async (generation) => {
      await this.prepare(generation, recipeJson, source);
      return this.answer(generation, 'forecast', generation.api.forecast(elements));
    }, signal);
  }

  /** Computes on the mesh of this recipe; stages that the worker no longer holds run before. */
  simulate(
    recipeJson: string,
    source: Partial<Recipe['source']>,
    stage: SimulationName,
    handlers: SimulationHandlers,
  ): Promise<{ summary: SimulationSummary; found: FoundFields; report: Report }> {
    return this.job(async (generation) => {
      await this.prepare(generation, recipeJson, source);
      const progress = Comlink.proxy((name: string, fraction: number) => handlers.onProgress(name, fraction));
      const frames = Comlink.proxy(async (frame: Frame) => handlers.onFrame(frame));
      const simulation = this.answer(generation, stage, generation.api.simulate(stage, progress, frames));
      generation.simulation = simulation;
      try {
        const summary = await simulation;
        const found = await this.answer(generation, stage, generation.api.found(stage));
        const report = await this.answer(generation, stage, generation.api.report());
        return { summary, found, report };
      } finally {
        generation.simulation = null;
      }
    }, handlers.signal);
  }

  /** Frames of a file with values at the points of the mesh of this recipe. */
  values(
    recipeJson: string,
    source: Partial<Recipe['source']>,
    file: VolumeFile,
    onFrame: (frame: Frame) => void,
  ): Promise<null> {
    return this.job(async (generation) => {
      await this.remesh(generation, recipeJson, source);
      const frames = Comlink.proxy(async (frame: Frame) => onFrame(frame));
      return this.answer(generation, 'values', generation.api.values(file, frames));
    });
  }

  /** The fibres that this recipe asks for. A simulation under way has made them, and is asked between two parts. */
  async fibres(recipeJson: string, source: Partial<Recipe['source']>): Promise<FibreArrays | null> {
    const now = this.generation;
    if (now.simulation) return this.answer(now, 'fibres', now.api.fibres());
    return this.job(async (generation) => {
      await this.prepare(generation, recipeJson, source);
      const silent = Comlink.proxy(() => undefined);
      await this.answer(generation, 'fibres', generation.api.run('fibres', silent));
      return this.answer(generation, 'fibres', generation.api.fibres());
    });
  }

  /** Excites the tissue in the simulation under way, `start_ms` from where it is; what it then has among its stimuli. */
  async stimulate(stimulus: Stimulus): Promise<Stimulus> {
    const now = this.generation;
    if (!now.simulation) throw failure('usage', 'No simulation is under way.', 'monodomain');
    const reply = now.api.stimulate(JSON.stringify(stimulus));
    return (await this.answer(now, 'monodomain', reply)).stimulus;
  }

  /** Holds the simulation under way, or lets it go on. */
  pauseSimulation(paused: boolean): void {
    if (this.generation.simulation) void this.generation.api.pauseSimulation(paused);
  }

  /** Files of the mesh of this recipe. */
  exportMesh(
    recipeJson: string,
    source: Partial<Recipe['source']>,
    format: ExportFormat,
    space: Space,
    name: string,
    measures = false,
    handlers: RunHandlers = {},
  ): Promise<ExportedFile[]> {
    return this.job(async (generation) => {
      await this.remesh(generation, recipeJson, source, handlers);
      return this.answer(generation, 'export', generation.api.exportMesh(format, space, name, measures));
    }, handlers.signal);
  }

  /** Ends it for good; what it is at fails as cancelled. */
  close(): void {
    this.closed = true;
    for (const generation of [this.generation, this.spare]) {
      generation?.end(cancelled());
      generation?.worker.terminate();
    }
    this.spare = null;
  }

  /** Ends whatever runs. Resolves when the engine answers again, with the milliseconds that took. */
  async cancel(): Promise<number> {
    const begin = performance.now();
    if (!(await endSimulation(this.generation))) {
      this.replace(cancelled());
      await this.generation.started;
    }
    return performance.now() - begin;
  }

  private async prepare(generation: Generation, recipeJson: string, source: Partial<Recipe['source']>) {
    const digest = source.file?.sha256;
    const options = readOptions(source);
    if (digest && generation.volume !== digest + options) {
      const file = this.files.volume(digest);
      if (!file) {
        throw failure(
          'usage',
          `Drop the file ${source.file?.name} first: this case was made from it.`,
          'volume',
        );
      }
      await this.answer(generation, 'volume', generation.api.loadVolume(file, options));
      generation.volume = digest + options;
    }
    const accepted = await this.answer(generation, 'recipe', generation.api.setRecipe(recipeJson));
    const { masks, images } = accepted.recipe.sizing;
    for (const [kind, sides] of [['mask', masks] as const, ['image', images] as const])
      for (const { name, sha256 } of sides) {
        const side = this.files.sideFor(kind, name, sha256);
        const key = sideKey(kind, name);
        // A file that is not there is the engine's to miss, once its stage comes.
        if (!side || generation.sides.get(key) === side) continue;
        await this.answer(generation, 'sizing', generation.api.loadSideVolume(kind, side.file));
        generation.sides.set(key, side);
      }
    return accepted;
  }

  /** Sees to the mesh of this recipe: stages that the worker no longer holds run again. */
  private async remesh(
    generation: Generation,
    recipeJson: string,
    source: Partial<Recipe['source']>,
    { onProgress }: RunHandlers = {},
  ): Promise<void> {
    await this.prepare(generation, recipeJson, source);
    const progress = Comlink.proxy((stage: StageName, fraction: number) => onProgress?.(stage, fraction));
    await this.answer(generation, 'optimise', generation.api.run('quality', progress));
  }

  private job<T>(body: (generation: Generation) => Promise<T>, signal?: AbortSignal): Promise<T> {
    const turn = this.tail.then(async () => {
      if (this.closed) throw failure('usage', 'The engine has been closed.');
      // An engine that cannot be started says so to the next job.
      const end = () => void this.cancel().catch(() => undefined);
      if (!this.generation.alive) this.generation = this.spawn();
      const generation = this.generation;
      this.runningJobs++;
      try {
        await unlessEnded(generation, generation.started);
        this.spare ??= this.spawn();
        if (signal?.aborted) throw cancelled();
        signal?.addEventListener('abort', end);
        return await body(generation);
      } finally {
        signal?.removeEventListener('abort', end);
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
      reply = await unlessEnded(generation, call);
    } catch (error) {
      if (error instanceof EngineError) throw error;
      const lost = failure('internal', `The engine stopped unexpectedly (${String(error)}).`, stage);
      this.retire(generation, lost);
      throw lost;
    }
    if (reply.ok) return reply.value;
    const error = new EngineError(reply.error);
    if (reply.error.fatal) this.retire(generation, error);
    throw error;
  }

  private compiled(): Promise<WebAssembly.Module> {
    if (!this.module) {
      this.module = this.setup.compile();
      this.module.catch(() => (this.module = undefined));
    }
    return this.module;
  }

  /** Ends a worker that cannot go on. */
  private retire(generation: Generation, reason: EngineError): void {
    if (generation === this.spare) {
      this.spare = null;
      generation.end(reason);
      generation.worker.terminate();
    } else if (generation.alive) this.replace(reason);
  }

  private replace(reason: EngineError): void {
    const old = this.generation;
    old.end(reason);
    old.worker.terminate();
    if (!this.closed) this.generation = this.spare?.alive ? this.spare : this.spawn();
    this.spare = null;
  }

  private spawn(): Generation {
    const lock = `voxtet-engine-${++this.generationCount}-${Math.random().toString(36).slice(2)}`;
    return startGeneration(this.setup, this.compiled(), lock, (generation, reason, hasStarted) => {
      // A worker that fails before it has started would fail again at once: the next job tries anew.
      if (generation === this.spare || hasStarted) this.retire(generation, reason);
      else generation.end(reason);
    });
  }
}
