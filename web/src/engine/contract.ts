/** What the engine says and takes: the JSON of the wasm surface, typed. Lengths mm, patient space RAS. */

/** The stages that the app shows. The engine's `tetra` runs by itself before `optimise`, `lookup` before `quality`. */
export const stageNames = ['volume', 'surface', 'smooth', 'sizing', 'remesh', 'optimise', 'quality'] as const;
export type StageName = (typeof stageNames)[number];

export type Vec3 = [number, number, number];

export type ErrorCode =
  'usage' | 'bad_input' | 'meshing' | 'differs' | 'out_of_memory' | 'cancelled' | 'internal';

/** Where an error is. Elements are triangles of the adapted surface, and the points their centroids. */
export interface ErrorPlace {
  points: Vec3[];
  elements: number[];
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
  /** The grid that is meshed; known once the volume has been prepared. */
  prepared?: { size: Vec3; spacing_mm: Vec3 };
}

export interface StageSummary {
  name: StageName;
  seconds: number;
  cached: boolean;
  peak_mb: number;
  digest: string;
  /** What a reader should know though nothing is wrong. */
  notes: string[];
  counts: Record<string, unknown>;
}

export interface Histogram {
  lo: number;
  hi: number;
  counts: number[];
}

export interface Metric {
  name: string;
  unit: string;
  elements: string;
  count: number;
  min: number;
  p01: number;
  p1: number;
  p5: number;
  median: number;
  p95: number;
  p99: number;
  max: number;
  mean: number;
  sd: number;
  histogram: Histogram;
  worst: number[];
}

export interface ChecklistItem {
  name: string;
  passed: boolean;
  hard: boolean;
  found: string;
  expected: string;
}

export interface LabelFidelity {
  label: number;
  voxels: number;
  tets: number;
  voxel_mm3: number;
  mesh_mm3: number;
  volume_error_percent: number;
  dice: number;
  median_edge_mm: number;
  wished_edge_mm: number;
}

/** Pairs are of the label surface and of the mesh. */
export interface LabelTopology {
  label: number;
  components: [number, number];
  cavities: [number, number];
  handles: [number, number];
  euler: [number, number];
  pinched_edges: number;
  pinched_points: number;
}

export interface TopologyComparison {
  labels: LabelTopology[];
  /** Pairs of labels that touch, 0 being background. */
  contacts: { before: [number, number][]; after: [number, number][] };
  differences: string[];
}

export interface DistanceSummary {
  samples: number;
  mean_mm: number;
  rms_mm: number;
  p95_mm: number;
  max_mm: number;
  uncertainty_mm: number;
}

/** A label given to tetrahedra three ways, against its voxels. */
export interface LookedUpLabel {
  label: number;
  voxel_mm3: number;
  by_fraction: { mm3: number; error_percent: number };
  by_centroid: { mm3: number; error_percent: number; dice: number };
  by_majority: { mm3: number; error_percent: number; dice: number };
}

export interface Report {
  engine: string;
  digest: string;
  tets: number;
  points: number;
  source: VolumeSummary;
  stages: StageSummary[];
  /** Absent where no label was to be looked up. */
  lookup?: LookedUpLabel[];
  quality: { metrics: Metric[]; checklist: ChecklistItem[]; passed: boolean };
  fidelity: {
    labels: LabelFidelity[];
    mesh_to_surface: DistanceSummary;
    surface_to_mesh: DistanceSummary;
    topology: TopologyComparison;
  };
  recipe: Recipe;
  warnings: string[];
}

export type PhantomKind =
  'sphere' | 'shell' | 'torus' | 'slab' | 'nested_boxes' | 'branching_tube' | 'biventricle';

export interface PhantomParams {
  kind: PhantomKind;
  spacing_mm: Vec3;
  rotation_deg: Vec3;
  mirrored: boolean;
  radius_mm: number;
  inner_radius_mm: number;
  thickness_mm: number;
  scale: number;
  roughness_mm: number;
  blood_pools: boolean;
  scar: boolean;
  seed: number;
}

export interface FileSource {
  name: string;
  sha256: string;
}

/** At most one is set; none: nothing has been chosen yet. */
export interface Source {
  phantom?: PhantomParams;
  file?: FileSource;
}

export type RegionShape = 'sphere' | 'box' | 'capsule';

export interface SizeRegion {
  name: string;
  shape: RegionShape;
  centre_mm: Vec3;
  end_mm: Vec3;
  half_size_mm: Vec3;
  axes_deg: Vec3;
  radius_mm: number;
  edge_mm: number;
  band_mm: number;
}

export interface Expected {
  engine: string;
  digest: string;
  tets: number;
}

/** The full recipe: every field present. What a link promises (`expected`) is kept apart from it. */
export interface Recipe {
  source: Source;
  labels: number[];
  /** Groups of labels; each is meshed as one region. */
  merge: number[][];
  volume: { slice_ratio: number; speck_voxels: number; hole_voxels: number };
  surface: { method: string };
  smooth: { iterations: number; step: number; max_move_voxels: number; keep_volume: boolean };
  sizing: {
    edge_mm: number;
    labels: { label: number; edge_mm: number }[];
    regions: SizeRegion[];
    distances: { label: number; edge_mm: number; slope: number }[];
    edge_min_mm: number;
    edge_max_mm: number;
    gradation: number;
  };
  remesh: {
    method: string;
    keep_topology: string;
    facet_angle_deg: number;
    max_distance_voxels: number;
    schedule: string;
    shape_weight: number;
    verify: boolean;
  };
  tetra: { backend: string; radius_edge: number; min_dihedral_deg: number; max_dihedral_deg: number };
  optimise: { rounds: number; min_dihedral_deg: number; insertion_deg: number; slide: number };
  lookup: { labels: number[]; samples_min: number; samples_max: number };
  quality: { histogram_bins: number; sample_spacing_voxels: number };
}

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
}

export const exportFormats = ['vtu', 'xdmf', 'msh', 'medit', 'carp', 'inp', 'feb', 'stl', 'ply'] as const;
export type ExportFormat = (typeof exportFormats)[number];
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
  /** How many half-faces are outer; outer or between labels; the largest distance of a corner from its centroid. */
  extents: Float64Array;
}

export const tetMeasures = [
  'min_dihedral_deg',
  'max_dihedral_deg',
  'radius_ratio',
  'mean_ratio',
  'aspect_ratio',
  'edge_mm',
  'size_log2',
] as const;
export type TetMeasure = (typeof tetMeasures)[number];

/** What was looked up in the image: a label, or a label's share, per tet. */
export type LookedUpArray = 'centroid_label' | 'majority_label' | `fraction_${number}`;

export interface StageArrays {
  volume: { labels: Uint16Array };
  surface: SurfaceArrays;
  smooth: SurfaceArrays;
  sizing: { h_mm: Float32Array };
  remesh: SurfaceArrays;
  optimise: TetArrays;
  quality: Record<TetMeasure, Float32Array> & Partial<Record<LookedUpArray, Float32Array>>;
}

/** What the worker answers; every call is one message there and one back. */
export interface EngineApi {
  start(module: WebAssembly.Module, scriptUrl: string, lock: string): Promise<EngineInfo>;
  loadVolume(file: VolumeFile): Reply<VolumeSummary>;
  setRecipe(json: string): Reply<{ recipe: Recipe; minimal: Record<string, unknown> }>;
  run(stage: StageName, onProgress: (stage: StageName, fraction: number) => void): Reply<StageSummary[]>;
  arrays(stage: StageName): Reply<Partial<StageArrays[StageName]>>;
  /** `name`: of the files without their suffixes, since some name one another. */
  exportMesh(format: ExportFormat, space: Space, name: string): Reply<ExportedFile[]>;
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
    this.where = { points: info.where?.points ?? [], elements: info.where?.elements ?? [] };
  }
}
