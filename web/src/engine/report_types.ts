/** A mesh's report: what it measures, what it is worth, and what simulations found on it. */
import type { StageSummary, Traces, VolumeSummary } from './contract';
import type { Recipe } from './recipe_types';

export interface Histogram {
  lo: number;
  hi: number;
  counts: number[];
}

export interface Metric {
  name: string;
  /** For people; empty where the app has its own words. */
  title: string;
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
  target_edge_mm: number;
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
  spacing_mm: number;
  mean_mm: number;
  rms_mm: number;
  p95_mm: number;
  max_mm: number;
  uncertainty_mm: number;
}

/** Parts of a wall's outer area: with the target number of layers beneath, and with no fewer. */
export interface LayerShares {
  /** Index: number of layers. */
  area_mm2: number[];
  exact: number;
  at_least: number;
}

export interface LayerCount {
  wall: number[];
  target_layers: number;
  by_edges: LayerShares;
  by_lines: LayerShares;
}

/** A label given to tetrahedra three ways, against its voxels. */
export interface TransferredLabel {
  label: number;
  voxel_mm3: number;
  by_fraction: { mm3: number; error_percent: number };
  by_centroid: { mm3: number; error_percent: number; dice: number };
  by_majority: { mm3: number; error_percent: number; dice: number };
}

/** What simulations of a mesh have found; times in ms, parts of all conducting points. */
export interface Simulated {
  eikonal?: { last_ms: number; activated: number };
  monodomain?: {
    end_ms: number;
    activated: number;
    total_activation_ms: number;
    mean_apd_ms?: number;
    most_activations: number;
    /** Of the first, second ... activation of each point, 20 at most. */
    beats: { activated: number; first_ms: number; last_ms: number }[];
    last_stimulus_ms: number;
    last_activation_ms: number;
    /** How long after the last stimulus a point was still activated. */
    lasted_ms: number;
    /** Absent without electrodes. */
    traces?: { times_ms: number[]; electrodes: { title: string; unit: string; values: number[] }[] };
  };
  mechanics?: {
    end_ms: number;
    frames: number;
    beats: Record<Ventricle, VentricleBeat>[];
    /** The last beat ended as the one before, within what the recipe asks for. */
    has_cycle: boolean;
    /** By how much the volumes at the end of the last two beats differ; absent after one. */
    change_percent?: number;
    steps: number;
    newton_iterations: number;
    traces: Traces;
  };
}

export type Ventricle = 'lv' | 'rv';

/** What a ventricle did in one beat. */
export interface VentricleBeat {
  end_diastolic_ml: number;
  end_systolic_ml: number;
  stroke_ml: number;
  ejection_fraction: number;
  most_kpa: number;
  stroke_work_j: number;
}

/** What was done to the slices of a stack. */
export interface SliceAlignment {
  axis: number;
  spread_mm: number;
  slices: {
    slice: number;
    move_mm: [number, number];
    given: boolean;
    dice_before: number;
    dice_after: number;
  }[];
}

export interface Report {
  engine: string;
  digest: string;
  tets: number;
  points: number;
  source: VolumeSummary;
  stages: (Omit<StageSummary, 'key'> & { digest: string })[];
  /** What was simulated, and the version of the physics; absent where nothing was. */
  simulation?: Simulated;
  physics?: string;
  /** Absent where no label was to be transferred. */
  transfer?: TransferredLabel[];
  /** Absent where no number of layers is a target. */
  layers?: LayerCount[];
  quality: { metrics: Metric[]; checklist: ChecklistItem[]; passed: boolean };
  /** Absent where the mesh was made elsewhere: there is nothing to compare it with. */
  fidelity?: {
    labels: LabelFidelity[];
    mesh_to_surface: DistanceSummary;
    surface_to_mesh: DistanceSummary;
    topology: TopologyComparison;
  };
  recipe: Recipe;
  warnings: string[];
}
