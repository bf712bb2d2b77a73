/** The engine for programs: a case in, a mesh as arrays or files out. Lengths mm, patient space RAS. */
import { EngineClient } from '../engine/client';
import {
  EngineError,
  type ElementOrder,
  type ExportFormat,
  type FieldInfo,
  type Forecast,
  type FoundFields,
  type Frame,
  type Recipe,
  type Report,
  type Schema,
  type SideKind,
  type Simulated,
  type SimulationName,
  type Space,
  type VolumeFile,
} from '../engine/contract';
import type { RecipeFields } from '../engine/generated';
import { failure, type EngineSetup } from '../engine/generation';

/** What of a recipe differs from the defaults. */
type Partially<T> = T extends readonly (infer Item)[]
  ? number extends T['length']
    ? Partially<Item>[]
    : T
  : T extends object
    ? { [Key in keyof T]?: Partially<T[Key]> }
    : T;
export type RecipeInput = Partially<RecipeFields>;

/** A file's bytes with its name, which tells the format, and files that its header names, by their names. */
export interface NamedBytes {
  name: string;
  bytes: Uint8Array | ArrayBuffer;
  siblings?: Record<string, Uint8Array<ArrayBuffer>>;
}

/** Bytes without a name are the file that the recipe names. */
export type VolumeInput = File | NamedBytes | Uint8Array | ArrayBuffer;

export interface JobOptions {
  onProgress?(stage: string, fraction: number): void;
  /** Ends the job; it then throws an EngineError with the code `cancelled`. */
  signal?: AbortSignal;
}

export interface RunOptions extends JobOptions {
  /** The label volume, where the recipe generates none; else the one of the run before. */
  volume?: VolumeInput;
  /** Files that the recipe's sizing.masks and sizing.images name. */
  masks?: (File | NamedBytes)[];
  images?: (File | NamedBytes)[];
}

export interface Mesh {
  /** Three coordinates a point, mm, RAS. */
  points: Float32Array;
  /** Four points a tetrahedron, from 0. */
  tets: Uint32Array;
  /** One a tetrahedron. */
  labels: Uint16Array;
  /** Measures and distances; what they mean, and one number for each element by name. */
  fields: FieldInfo[];
  values: Record<string, Float32Array>;
}

export interface Result {
  mesh: Mesh;
  report: Report;
  /** The whole recipe, with each default. */
  recipe: Recipe;
}

export interface ExportOptions extends JobOptions {
  /** Of the files, without suffix; `mesh` if none is given. */
  name?: string;
  /** Patient space of the coordinates; `ras` if none is given. */
  space?: Space;
  /** The measures of the tetrahedra too, where the format holds them. */
  measures?: boolean;
  /** Of the elements; 2 for `vtu`, `msh`, `msh22`, `inp`, `feb` and `xdmf` alone; 1 if none is given. */
  order?: ElementOrder;
}

export interface MeshFile {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

export interface SimulateOptions extends JobOptions {
  onFrame?(frame: Frame): void;
}

/** Bytes that nobody else has: they stay with the engine. */
const owned = (bytes: Uint8Array | ArrayBuffer): Uint8Array<ArrayBuffer> => new Uint8Array(bytes).slice();

async function volumeFile(input: VolumeInput, nameInRecipe?: string): Promise<VolumeFile> {
  if (input instanceof File)
    return { name: input.name, bytes: new Uint8Array(await input.arrayBuffer()), siblings: {} };
  if ('bytes' in input)
    return { name: input.name, bytes: owned(input.bytes), siblings: input.siblings ?? {} };
  if (nameInRecipe) return { name: nameInRecipe, bytes: owned(input), siblings: {} };
  throw failure(
    'usage',
    'The volume has no name: give a File, { name, bytes }, or source.file.name.',
    'volume',
  );
}

export class Mesher {
  private readonly client: EngineClient;
  /** Every field that a recipe can have. */
  readonly schema: Schema;
  readonly defaults: Recipe;
  /** The file that was read last, as recipes name it. */
  private file: Recipe['source']['file'];
  private lastRun: Promise<unknown> = Promise.resolve();
  /** The recipe of the last mesh. */
  private meshed: Recipe | null = null;

  private constructor(client: EngineClient, schema: Schema, defaults: Recipe) {
    this.client = client;
    this.schema = schema;
    this.defaults = defaults;
  }

  /** @internal Use `createMesher`. */
  static async start(setup: EngineSetup): Promise<Mesher> {
    const client = new EngineClient(setup);
    try {
      const { schema, defaults } = await client.ready;
      return new Mesher(client, schema, defaults);
    } catch (error) {
      client.close();
      throw error instanceof EngineError
        ? error
        : failure('internal', `The engine could not be loaded (${String(error)}).`);
    }
  }

  /** The engine's version, and the digest of its sources. */
  get version(): string {
    return this.schema.version;
  }

  /** A recipe with every field, as the engine takes it; or why it does not. */
  async check(recipe: RecipeInput): Promise<Recipe> {
    return (await this.client.checkRecipe(recipe)).recipe;
  }

  /** Meshes a case. What has not changed since the run before is kept. Runs wait for one another. */
  run(recipe: RecipeInput, options: RunOptions = {}): Promise<Result> {
    // Each with its own files: the next may bring others.
    const turn = this.lastRun.then(() => this.runNow(recipe, options));
    this.lastRun = turn.catch(() => undefined);
    return turn;
  }

  private async runNow(recipe: RecipeInput, options: RunOptions): Promise<Result> {
    const { volume, masks = [], images = [], onProgress, signal } = options;
    const source = volume ? ({ ...recipe.source } as Partial<Recipe['source']>) : this.sourceOf(recipe);
    if (volume) source.file = await this.read(volume, source);
    await this.readSides('mask', masks);
    await this.readSides('image', images);
    const mesh: Partial<Mesh> = {};
    const { recipe: full, report } = await this.client.run(
      JSON.stringify({ ...recipe, source }),
      source,
      'quality',
      {
        signal,
        onProgress,
        wants: ({ name }) => name === 'optimise' || name === 'quality',
        onStage: (_, arrays) => void Object.assign(mesh, arrays),
      },
    );
    if (!report) throw failure('internal', 'The engine gave no report.', 'quality');
    this.meshed = full;
    const { points, tets, labels, fields, values } = mesh as Mesh;
    return { mesh: { points, tets, labels, fields, values }, report, recipe: full };
  }

  /** What meshing will take, and with `tets` the sizes that give so many. A file must have been read by a run. */
  forecast(recipe: RecipeInput, tets = 0, signal?: AbortSignal): Promise<Forecast> {
    const source = this.sourceOf(recipe);
    return this.client.forecast(JSON.stringify({ ...recipe, source }), source, tets, signal);
  }

  /** Computes on the last mesh: `eikonal`, `monodomain`, `mechanics` or `diffusion`. Fields hold -1e30 where there is no value. */
  async simulate(
    physics: SimulationName,
    { onProgress = () => undefined, onFrame = () => undefined, signal }: SimulateOptions = {},
  ): Promise<FoundFields & { simulation: Simulated }> {
    const recipe = this.lastRecipe();
    const handlers = { onProgress, onFrame, signal };
    const { found, report } = await this.client.simulate(
      JSON.stringify(recipe),
      recipe.source,
      physics,
      handlers,
    );
    return { ...found, simulation: report.simulation ?? {} };
  }

  /** The last mesh as files: some formats have several. */
  async export(format: ExportFormat, options: ExportOptions = {}): Promise<MeshFile[]> {
    const { name = 'mesh', space = 'ras', measures = false, order = 1, onProgress, signal } = options;
    const recipe = this.lastRecipe();
    const handlers = { onProgress, signal };
    const json = JSON.stringify(recipe);
    const files = await this.client.exportMesh(
      json,
      recipe.source,
      format,
      space,
      name,
      { measures, order },
      handlers,
    );
    return files.map(({ suffix, bytes }) => ({ name: `${name}${suffix}`, bytes }));
  }

  /** Ends the engine and its workers; node does not end before. */
  close(): void {
    this.client.close();
  }

  /** That of a recipe; where it names none, the file that was read last. */
  private sourceOf(recipe: RecipeInput): Partial<Recipe['source']> {
    const source = { ...recipe.source } as Partial<Recipe['source']>;
    return source.file || source.phantom || source.inline ? source : { ...source, file: this.file };
  }

  private lastRecipe(): Recipe {
    if (!this.meshed) throw failure('usage', 'There is no mesh yet: run a case first.');
    return this.meshed;
  }

  /** Reads a volume, which must have the digest of the recipe if there is one. */
  private async read(input: VolumeInput, source: Partial<Recipe['source']>) {
    const { name: nameInRecipe, sha256 = '' } = source.file ?? {};
    const file = await volumeFile(input, nameInRecipe);
    const { digest } = await this.client.openVolume(file, source);
    if (sha256 && sha256 !== digest)
      throw failure(
        'differs',
        `${file.name} has the digest ${digest}, the case was made with ${sha256}`,
        'volume',
      );
    this.client.files.forgetVolumes(digest);
    this.file = { name: file.name, sha256: digest, url: source.file?.url ?? '' };
    return this.file;
  }

  private async readSides(kind: SideKind, inputs: (File | NamedBytes)[]): Promise<void> {
    for (const input of inputs) await this.client.openSideVolume(kind, await volumeFile(input));
  }
}
