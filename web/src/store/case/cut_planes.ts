/** Planes that cut labels off: the fields `volume.cut` of a recipe. */
import type { Recipe, Vec3 } from '../../engine/contract';
import { sliceFrames, type SliceName } from '../../geometry/orientation';
import { volume } from './input';

export type CutPlane = Recipe['volume']['cut'][number];

/** Across the axial slice, head side away: the first is the base of a heart. */
export function newCut(existing: readonly CutPlane[], point_mm: Vec3): CutPlane {
  return {
    name: existing.some(({ name }) => name === 'base') ? '' : 'base',
    labels: [],
    point_mm,
    normal: acrossSlice('axial'),
  };
}

/** Across a slice of the image: to the head, the front, the right. */
export function acrossSlice(name: SliceName): Vec3 {
  const plain: Record<SliceName, Vec3> = { axial: [0, 0, 1], coronal: [0, 1, 0], sagittal: [1, 0, 0] };
  const wanted = plain[name];
  const known = volume.value;
  const across = known && sliceFrames(known.index_to_mm).find((frame) => frame.name === name)?.towards;
  if (!across) return wanted;
  const sign = across.reduce((sum, part, i) => sum + part * wanted[i], 0) < 0 ? -1 : 1;
  return across.map((part) => Math.round(1e4 * sign * part) / 1e4 + 0) as Vec3;
}

export function turned(normal: Vec3): Vec3 {
  return normal.map((part) => 0 - part) as Vec3;
}

/** What the engine calls the surface: its name, or cut, cut_2, ... where it has none. */
export function surfaceName(cuts: readonly CutPlane[], index: number): string {
  const names = new Set(cuts.map(({ name }) => name));
  for (const [i, { name }] of cuts.entries()) {
    let given = name;
    for (let next = 1; given === ''; ++next) {
      const free = next === 1 ? 'cut' : `cut_${next}`;
      if (!names.has(free)) given = free;
    }
    names.add(given);
    if (i === index) return given;
  }
  return '';
}
