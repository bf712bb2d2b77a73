import { sentence } from '../controls/format';

/** Plain words for fields and choices whose names in the recipe say too little. */
const words: Record<string, string> = {
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
  'limits.tets': 'Most tetrahedra',
  'limits.memory_mb': 'Most memory',
  'limits.seconds': 'Most time',
};

const units: Record<string, string> = { deg: '°', voxel: 'vx' };

export function fieldWords(path: string): string {
  return words[path] ?? sentence(path.slice(path.lastIndexOf('.') + 1));
}

export function choiceWords(path: string, value: string): string {
  return words[`${path}=${value}`] ?? value.replaceAll('_', ' ');
}

export function fieldUnit(path: string, unit = ''): string {
  return path === 'volume.slice_ratio' ? '×' : (units[unit] ?? unit);
}
