import { sentence } from './format';

/** Plain words for fields and choices whose names in the recipe say too little. */
const words: Record<string, string> = {
  'sizing.edge_mm': 'Edge length',
  'sizing.gradation': 'Growth per mm',
  'sizing.edge_min_mm': 'Smallest edge',
  'sizing.edge_max_mm': 'Largest edge',
  'sizing.labels.edge_mm': 'Edge length of a label',
  'volume.slice_ratio': 'Interpolate slices above',
  'volume.speck_voxels': 'Remove pieces below',
  'volume.hole_voxels': 'Fill holes below',
  'volume.handle_voxels': 'Mend thin handles below',
  'volume.flat_border': 'Flat where the image ends',
  'volume.align_slices': 'Put shifted slices back',
  'volume.largest_shift_mm': 'Largest move of a slice',
  'smooth.max_move_voxels': 'Largest move',
  'remesh.method': 'Made by',
  'remesh.method=delaunay': 'Delaunay refinement',
  'remesh.method=adapt': 'local operations',
  'remesh.keep_topology': 'Else adapt at',
  'remesh.keep_topology=labels': 'label lost or pinched',
  'remesh.keep_topology=all': 'any topology change',
  'remesh.keep_topology=nothing': 'never',
  'remesh.facet_angle_deg': 'Smallest angle',
  'remesh.max_distance_voxels': 'Distance to the labels',
  'remesh.schedule': 'Order of local operations',
  'remesh.schedule=adaptive': 'adaptive',
  'remesh.schedule=paper': 'coarsen, then refine',
  'remesh.shape_weight': 'Shape against size',
  'remesh.verify': 'Check every operation (slow)',
  'tetra.backend=tetgen': 'TetGen',
  'tetra.backend=delaunay': 'Delaunay refinement',
  'tetra.radius_edge': 'Radius over edge',
  'tetra.min_dihedral_deg': 'Smallest dihedral',
  'tetra.max_dihedral_deg': 'Largest dihedral',
  'optimise.min_dihedral_deg': 'Work below',
  'optimise.insertion_deg': 'Insert vertices below',
  'optimise.slide': 'Slide on the surface',
  'quality.sample_spacing_voxels': 'Sample spacing',
  'physics.tissue.kinds.along_mm_per_ms': 'Speed along',
  'physics.tissue.kinds.across_mm_per_ms': 'Speed across',
  'limits.tets': 'Most tetrahedra',
  'limits.memory_mb': 'Most memory',
  'limits.seconds': 'Most time',
};

const units: Record<string, string> = { deg: '°', voxel: 'vx' };
/** Numbers without a unit that something is multiplied by. */
const factors = new Set([
  'volume.slice_ratio',
  ...['scale', 'wall_scale', 'length_scale', 'rv_dilation'].map((name) => `source.phantom.${name}`),
]);

export function fieldWords(path: string): string {
  return words[path] ?? sentence(path.slice(path.lastIndexOf('.') + 1));
}

export function choiceWords(path: string, value: string): string {
  return words[`${path}=${value}`] ?? value.replaceAll('_', ' ');
}

export function fieldUnit(path: string, unit = ''): string {
  return factors.has(path) ? '×' : (units[unit] ?? unit);
}

/** What parts of the recipe are called on the page. */
export const groupWords: Record<string, string> = {
  source: 'Source',
  labels: 'Labels',
  merge: 'Labels meshed as one',
  sizing: 'Element size',
  volume: 'Volume',
  surface: 'Label surface',
  smooth: 'Smoothing',
  remesh: 'Adapted surface',
  tetra: 'Tetrahedra',
  optimise: 'Better shapes',
  quality: 'Evidence',
  limits: 'Limits',
  physics: 'Physics',
};

/** A path of the recipe in words, things of lists by number, and its unit: what is compared stands alone. */
export function pathWords(path: string): { name: string; unit: string } {
  const [group, ...rest] = path.split('.');
  const number = rest.find((part) => /^\d+$/.test(part));
  const field = fieldWords([group, ...rest.filter((part) => part !== number)].join('.'));
  const title = groupWords[group] ?? sentence(group);
  const name = rest.length === 0 ? title : `${title}: ${field.charAt(0).toLowerCase()}${field.slice(1)}`;
  const unit = { mm: ' mm', deg: '°' }[path.slice(path.lastIndexOf('_') + 1)] ?? '';
  return { name: number ? `${name}, number ${Number(number) + 1}` : name, unit };
}
