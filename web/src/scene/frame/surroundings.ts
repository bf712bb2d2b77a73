/** How open the body's places are to their surroundings: what is in a cavity gets less light. */
import { Data3DTexture, LinearFilter, Matrix4, RedFormat, UnsignedByteType, Vector3, Vector4 } from 'three';
import type { Labels, Vec3, VolumeSummary } from '../../engine/contract';
import { fullness, openness, type Fullness } from '../../geometry/fullness';

/** A plane that clips nothing: what lies on its side of normal . p <= offset stays. */
export const noClip = new Vector4(0, 0, 0, 1);

/** Shared by the materials of all bodies. */
export const surroundings = {
  open: { value: null as Data3DTexture | null },
  /** From millimetres to places in the texture, 0 to 1. */
  toOpen: { value: new Matrix4() },
  /** The length of a cell, mm; 0: nothing is known. */
  cell: { value: 0 },
};

let known: Fullness | null = null;

export function forgetSurroundings(): void {
  surroundings.open.value?.dispose();
  surroundings.open.value = null;
  surroundings.cell.value = 0;
  known = null;
}

/** Takes an image with the labels that the body has. */
export function setSurroundings(
  labels: Labels,
  image: VolumeSummary,
  counts: (label: number) => boolean,
): void {
  forgetSurroundings();
  known = fullness(labels, image, counts);
  const { size, voxels } = known;
  const texture = new Data3DTexture(new Uint8Array(known.data.length), ...size);
  texture.format = RedFormat;
  texture.type = UnsignedByteType;
  texture.unpackAlignment = 1;
  texture.magFilter = texture.minFilter = LinearFilter;
  surroundings.open.value = texture;
  const scale = size.map((cells, axis) => 1 / (cells * voxels[axis]));
  // Voxels lie around whole numbers: the first begins at -1/2.
  surroundings.toOpen.value
    .set(...(image.index_to_mm as Parameters<Matrix4['set']>))
    .invert()
    .premultiply(new Matrix4().makeTranslation(0.5, 0.5, 0.5))
    .premultiply(new Matrix4().makeScale(scale[0], scale[1], scale[2]));
  surroundings.cell.value = Math.max(...voxels.map((count, axis) => count * image.spacing_mm[axis]));
}

/** A cut opens what lay behind it: normal . p <= offset stays. */
export function cutSurroundings(plane: { normal: readonly number[]; offset: number } | null): void {
  const texture = surroundings.open.value;
  if (!known || !texture) return;
  const { size } = known;
  const toMm = surroundings.toOpen.value.clone().invert();
  const place = new Vector3();
  const isGone = ([x, y, z]: Vec3) => {
    place.set((x + 0.5) / size[0], (y + 0.5) / size[1], (z + 0.5) / size[2]).applyMatrix4(toMm);
    const [a, b, c] = plane!.normal;
    return a * place.x + b * place.y + c * place.z > plane!.offset;
  };
  texture.image.data = openness(known, plane ? isGone : undefined);
  texture.needsUpdate = true;
}
