/** What the engine says and takes: the JSON of the wasm surface, typed. Lengths mm, patient space RAS. */
import { stageNames } from './generated';
import type { Recipe, Stimulus, Vec3 } from './recipe_types';
import type { Report } from './report_types';

export * from './recipe_types';
export * from './report_types';

export { stageNames };
export type StageName = (typeof stageNames)[number];

/** The stages of a mesh that was made elsewhere. */
export const stagesOfMesh: readonly StageName[] = ['volume', 'optimise', 'quality'];

/** Stages of physics. They run when they are asked for; those that are worked on in short steps give frames. */
export type SimulationName = 'eikonal' | 'monodomain' | 'mechanics' | 'diffusion';

/** Those whose result a case may promise. */
export const promisedStages = ['eikonal', 'monodomain', 'mechanics'] as const;

export type ErrorCode =
  | 'usage'
  | 'bad_input'
  | 'meshing'
  | 'differs'
  | 'out_of_memory'
  | 'cancelled'
  | 'internal';

/** Where an error is: points, and elements of the kind `on` of a stage's result, if any is at hand. */
export interface ErrorPlace {
  points: Vec3[];
  elements: number[];
  stage: string;
  on: FieldInfo['on'];
}

export interface ErrorInfo {
  code: ErrorCode;
  stage: string;
  message: string;
  where?: Partial<ErrorPlace>;
  /** The engine instance can no longer be trusted; its worker must be replaced. */
  fatal?: boolean;
}

export type Reply<T> = { ok: true; value: T } | { ok: false; error: ErrorInfo };

export interface LabelSummary {
  label: number;
  name: string;
  colour: string | null;
  voxels: number;
}

export interface VolumeSummary {
  name: string;
  size: Vec3;
  spacing_mm: Vec3;
  index_to_mm: number[];
  digest: string;
  labels: LabelSummary[];
  /** Of reading and preparing it. */
  warnings: string[];
  /** Of a mesh that was made elsewhere: the volume holds its labels, and no stage makes another. */
  mesh?: { points: number; tets: number; fibres: boolean };
  /** The grid that is meshed; known once the volume has been prepared. */
  prepared?: { size: Vec3; spacing_mm: Vec3 };
  /** What lies around each label; known once the volume has been prepared. */
  surroundings?: Surroundings[];
  /** Noise of the segmentation in what is meshed; known once the volume has been prepared. */
  flaws?: Flaw[];
}

export interface Surroundings {
  label: number;
  /** Labels across its boundary, 0 too, with their parts of its area; the four largest. */
  contacts: { label: number; share: number }[];
  /** Its part of the voxels at the image's border. */
  border_share: number;
}

export interface Flaw {
  kind: 'pieces' | 'holes' | 'handles' | 'tunnels' | 'pits';
  count: number;
  voxels: number;
  largest: number;
  /** Labels, and how many each has. */
  labels: [number, number][];
  text: string;
}

export interface StageSummary {
  name: StageName;
  seconds: number;
  cached: boolean;
  peak_mb: number;
  /** Of all that the result was made from: with the same key it is the same. */
  key: string;
  /** What a reader should know though nothing is wrong. */
  notes: string[];
  counts: Record<string, unknown>;
}

export type SimulationSummary = Omit<StageSummary, 'name'> & { name: SimulationName };

export interface SchemaField {
  path: string;
  type: 'number' | 'integer' | 'boolean' | 'string' | 'enum' | 'vec3' | 'labels' | 'label_groups' | 'list';
  unit?: string;
  default?: unknown;
  min?: number;
  max?: number;
  values?: string[];
  description?: string;
  items?: SchemaField[];
}

export interface Schema {
  version: string;
  fields: SchemaField[];
  /** Groups that a recipe may leave out, by their paths. */
  optional_groups: string[];
  /** Values of fields that go together, by group. */
  presets?: {
    thick_stack: { volume: Partial<Recipe['volume']>; smooth: Partial<Recipe['smooth']> };
    cleaning: { volume: Pick<Recipe['volume'], 'speck_voxels' | 'hole_voxels' | 'handle_voxels'> };
  };
}

/** What meshing will take, as foretold from the sizing field. */
export interface Forecast {
  tets: number;
  points: number;
  triangles: number;
  /** At the most, in MB; and of all stages. */
  peak_mb: number;
  seconds: number;
  /** The least and the most on this machine, by how long it took for the label surface. */
  seconds_here: [number, number];
}

/** Edge lengths of the recipe, all times one factor, and what they will take. */
export interface FittingSizes {
  factor: number;
  edge_mm: number;
  sizing: Recipe['sizing'];
  forecast: Forecast;
}

export const meshFormats = [
  ...(['vtu', 'vtk', 'xdmf', 'msh', 'msh22', 'medit', 'carp', 'inp', 'bdf', 'feb', 'tetgen'] as const),
  ...(['stl', 'label_stl', 'ply'] as const),
] as const;
/** Cases of mechanics, of a mesh with anatomy and fibres. */
export const caseFormats = ['feb_case', 'svmultiphysics'] as const;
export const exportFormats = [...meshFormats, ...caseFormats] as const;
export type ExportFormat = (typeof exportFormats)[number];

/** Of tetrahedra: 1 has four nodes; 2 has ten, those on the boundary on the smoothed label surface. */
export type ElementOrder = 1 | 2;
/** Formats that have elements of second order. */
export const secondOrderFormats: readonly ExportFormat[] = [
  'vtu',
  'msh',
  'msh22',
  'inp',
  'feb',
  'xdmf',
  'feb_case',
];
export type Space = 'ras' | 'lps';

export interface ExportedFile {
  suffix: string;
  bytes: Uint8Array<ArrayBuffer>;
}

export interface VolumeFile {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
  siblings: Record<string, Uint8Array<ArrayBuffer>>;
}

/** What a file beside the volume is for. */
export type SideKind = 'mask' | 'image';

export interface SideSummary {
  name: string;
  digest: string;
  /** Of a mask. */
  labels: number[];
}

export interface SurfaceArrays {
  points: Float32Array;
  triangles: Uint32Array;
  sides: Uint16Array;
  /** Nine per triangle, for a surface that is finer than the eye follows. */
  normals?: Float32Array;
}

export interface TetArrays {
  points: Float32Array;
  tets: Uint32Array;
  labels: Uint16Array;
  /** Four per tet: the tet across the face opposite corner i, or -1. */
  neighbours: Int32Array;
  /** Half-faces, 4·tet + opposite corner: outer ones, those between labels (both sides), one of each other pair. */
  faces: Uint32Array;
  /** Four per tet: its centroid in mm, and its label. */
  centres: Float32Array;
  /** Four per label: it, and the way from the body's middle to its own. */
  ways: Float32Array;
  /** How many half-faces are outer; outer or between labels; the largest distance of a corner from its centroid. */
  extents: Float64Array;
}

/** What the engine says of a field: an array with values for each element. */
export interface FieldInfo {
  name: string;
  title: string;
  unit: string;
  on: 'voxels' | 'triangles' | 'points' | 'tets' | 'faces';
  /** 'cyclic' is the page's own: its ends are the same. */
  scale: 'sequential' | 'diverging' | 'whole' | 'label' | 'cyclic';
  components: number;
  count: number;
  /** Least and largest finite value. */
  range: [number, number] | null;
}

/** One frame of a result that lives in time: its fields, and their values by name. */
export interface Frame {
  timeMs: number;
  /** Each with one number an element; of a vector its length. */
  fields: FieldInfo[];
  values: Record<string, Float32Array>;
  /** How far each point of a body that moves is from where it was: three numbers a point, mm. */
  moves?: Float32Array;
  /** What was recorded since the frame before, where there is anything. */
  traces?: Traces;
}

/** Values at some times, ms, in one line for each thing that is recorded. */
export interface Traces {
  times_ms: number[];
  lines: Trace[];
}

export interface Trace {
  name: string;
  title: string;
  unit: string;
  values: number[];
}

/** Of voxels; in bytes where they fit. */
export type Labels = Uint8Array | Uint16Array;

export interface StageArrays {
  volume: { labels: Labels };
  surface: SurfaceArrays;
  smooth: SurfaceArrays;
  /** Edge lengths on the field's grid; thickness of the walls on the prepared volume's, 0 outside of them. */
  sizing: { h_mm: Float32Array; thickness_mm?: Float32Array };
  remesh: SurfaceArrays;
  optimise: TetArrays;
  /** Fields of tetrahedra and points by name; a whole number or a distance below 0 is none. */
  quality: { fields: FieldInfo[]; values: Record<string, Float32Array> };
}

/** In place of a value at a point that has none: for shaders, which cannot tell what is not a number. */
export const noValue = -1e30;

/** Fibres of the mesh: directions, and how steep they are. */
export interface FibreArrays {
  /** Three numbers a tet: a unit vector whose sign means nothing; 0 where there is no muscle. */
  fibre: Float32Array;
  /** One a tet, degrees; `noValue` where there is none. Null where no wall is known that they wind through. */
  helix: Float32Array | null;
}

/** Fields that a simulation has found, at its end, and those that it was made from. */
export type FoundFields = StageArrays['quality'];

/** Addresses of the engine's script, and of that of its threads where it is not named by the engine. */
export interface EngineScripts {
  engine: string;
  thread?: string;
}

/** What the worker answers; every call is one message there and one back. */
export interface EngineApi {
  start(module: WebAssembly.Module, scripts: EngineScripts, lock: string): Promise<EngineInfo>;
  /** `source`: that of a recipe as JSON, of which counts how the file is read. */
  loadVolume(file: VolumeFile, source: string): Reply<VolumeSummary>;
  /** Takes a file that the recipe's sizing.masks or sizing.images name. */
  loadSideVolume(kind: SideKind, file: VolumeFile): Reply<SideSummary>;
  setRecipe(json: string): Reply<{ recipe: Recipe; minimal: Record<string, unknown> }>;
  /** The case with its label volume within it, in the place of a file. */
  inlineCase(): Reply<{ recipe: Recipe; minimal: Record<string, unknown> }>;
  run(
    stage: StageName | 'fibres',
    onProgress: (stage: StageName, fraction: number) => void,
  ): Promise<Reply<StageSummary>>;
  /** The same for a simulation, which hands over its frames, and between two parts hears the two that follow. */
  simulate(
    stage: SimulationName,
    onProgress: (stage: string, fraction: number) => void,
    onFrame: (frame: Frame) => Promise<void>,
  ): Promise<Reply<SimulationSummary>>;
  /** The fields of a simulation that is done, `noValue` where points have none. */
  found(stage: SimulationName): Reply<FoundFields>;
  /** Those that the last run has made or needed; null where the recipe asks for none. Heard between two parts. */
  fibres(): Reply<FibreArrays | null>;
  /**
   * Gives the simulation under way a stimulus of the recipe, as JSON, whose `start_ms` counts from now. It is among the
   * engine's own stimuli from then on; the reply has it with the time at which it starts.
   */
  stimulate(json: string): Reply<{ stimulus: Stimulus }>;
  pauseSimulation(paused: boolean): void;
  /** It answers `cancelled`; what was complete before it stays. */
  endSimulation(): void;
  /**
   * Hands over values that were found elsewhere at the points of this mesh: one frame of openCARP's .dat, those of
   * its .igb.
   */
  values(file: VolumeFile, onFrame: (frame: Frame) => Promise<void>): Promise<Reply<null>>;
  /** After the stages up to sizing. With `elements` above 0 also the sizes that give so many tetrahedra. */
  forecast(elements: number): Reply<Forecast & { fitting?: FittingSizes }>;
  arrays(stage: StageName): Reply<Partial<StageArrays[StageName]>>;
  /** `name`: of the files without their suffixes, since some name one another. */
  exportMesh(
    format: ExportFormat,
    space: Space,
    name: string,
    measures: boolean,
    order: ElementOrder,
  ): Reply<ExportedFile[]>;
  report(): Reply<Report>;
}

export interface EngineInfo {
  schema: Schema;
  defaults: Recipe;
}

export class EngineError extends Error {
  readonly code: ErrorCode;
  readonly stage: string;
  readonly where: ErrorPlace;

  constructor(info: ErrorInfo) {
    super(info.message);
    this.name = 'EngineError';
    this.code = info.code;
    this.stage = info.stage;
    const { points = [], elements = [], stage = '', on = 'triangles' } = info.where ?? {};
    this.where = { points, elements, stage, on };
  }
}
