/** The recipe: what is meshed, and how. Lengths mm, patient space RAS. */

export type Vec3 = [number, number, number];

export type PhantomKind =
  | 'sphere'
  | 'shell'
  | 'torus'
  | 'slab'
  | 'nested_boxes'
  | 'branching_tube'
  | 'biventricle';

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

/** Size by the thickness of a wall: its part of `layers`, or linear from thin to thick (both 0: as measured). */
export interface ThicknessSize {
  wall: number[];
  /** None: the cavities of the background. */
  inner: number[];
  layers: number;
  /** Layers by the size of the elements alone, or sheets laid across the wall. */
  layering: 'size' | 'exact';
  edge_thin_mm: number;
  edge_thick_mm: number;
  thin_mm: number;
  thick_mm: number;
}

/** A size for each label of a mask in a file of its own. */
export interface MaskSize extends FileSource {
  edges: { label: number; edge_mm: number }[];
}

/** Size by the curvature of the surfaces of these labels; none: all. */
export interface CurvatureSize {
  labels: number[];
  edges_per_turn: number;
  edge_min_mm: number;
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
    thickness: ThicknessSize[];
    masks: MaskSize[];
    /** Edge lengths in mm, in files of their own. */
    images: FileSource[];
    curvature: CurvatureSize[];
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
  /** What meshing may take, by forecast; 0: no limit. */
  limits: { tets: number; memory_mb: number; seconds: number };
}
