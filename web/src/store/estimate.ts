import type { Recipe, SizeRegion, VolumeSummary } from '../engine/contract';

/** A regular tetrahedron of edge h fills h³/(6√2); measured meshes hold about this many times as many. */
const elementsPerRegular = 1.15;

/** Tetrahedra to expect: the volume of each label and region over that of an element of its wished edge. */
export function estimateTets(recipe: Recipe, volume: VolumeSummary): number {
  const count = (mm3: number, edge: number) => (elementsPerRegular * mm3 * 6 * Math.SQRT2) / edge ** 3;
  const [x, y, z] = volume.spacing_mm;
  const wished = new Map(recipe.sizing.labels.map((entry) => [entry.label, entry.edge_mm]));
  const chosen = new Set(recipe.labels);
  let tets = 0;
  let body = 0;
  for (const { label, voxels } of volume.labels) {
    if (chosen.size > 0 && !chosen.has(label)) continue;
    body += voxels * x * y * z;
    tets += count(voxels * x * y * z, wished.get(label) ?? recipe.sizing.edge_mm);
  }
  for (const region of recipe.sizing.regions) {
    if (region.edge_mm < recipe.sizing.edge_mm)
      tets += count(Math.min(body, regionVolume(region)), region.edge_mm);
  }
  return Math.round(tets);
}

function regionVolume(region: SizeRegion): number {
  const ball = (4 / 3) * Math.PI * region.radius_mm ** 3;
  switch (region.shape) {
    case 'sphere':
      return ball;
    case 'box':
      return 8 * region.half_size_mm[0] * region.half_size_mm[1] * region.half_size_mm[2];
    case 'capsule': {
      const length = Math.hypot(...region.end_mm.map((end, axis) => end - region.centre_mm[axis]));
      return ball + Math.PI * region.radius_mm ** 2 * length;
    }
  }
}
