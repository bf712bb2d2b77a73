import type { Vec3 } from '../engine/contract';
import { toMm } from '../geometry/orientation';
import { volume } from './case/input';
import { slicePlaces } from './view';

/** Where the crosshair is, mm, to a tenth. */
export function crosshairMm(): Vec3 {
  const known = volume.value;
  if (!known) return [0, 0, 0];
  const index = slicePlaces.value.map((place, axis) => Math.round(place * (known.size[axis] - 1)));
  return toMm(known.index_to_mm, index).map((x) => Math.round(10 * x) / 10) as Vec3;
}
