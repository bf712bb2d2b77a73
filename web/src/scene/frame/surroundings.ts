/** How much lies around a place of the body: what is in a cavity gets less light. */
import {
  Data3DTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  Matrix4,
  RedFormat,
  UnsignedByteType,
  Vector4,
} from 'three';
import type { VolumeSummary } from '../../engine/contract';
import { fullness } from '../../geometry/fullness';

/** A plane that clips nothing: what lies on its side of normal . p <= offset stays. */
export const noClip = new Vector4(0, 0, 0, 1);

/** Shared by the materials of all bodies. */
export const surroundings = {
  full: { value: null as Data3DTexture | null },
  /** From millimetres to places in the texture, 0 to 1. */
  toFull: { value: new Matrix4() },
  /** The length of a cell, mm; 0: nothing is known. */
  cell: { value: 0 },
  /** Beyond it a cut has taken all away. */
  kept: { value: noClip.clone() },
};

export function forgetSurroundings(): void {
  surroundings.full.value?.dispose();
  surroundings.full.value = null;
  surroundings.cell.value = 0;
}

/** Takes an image with the labels that the body has. */
export function setSurroundings(
  labels: Uint16Array,
  image: VolumeSummary,
  counts: (label: number) => boolean,
): void {
  forgetSurroundings();
  const { data, size, voxels } = fullness(labels, image, counts);
  const texture = new Data3DTexture(data, ...size);
  texture.format = RedFormat;
  texture.type = UnsignedByteType;
  texture.unpackAlignment = 1;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  surroundings.full.value = texture;
  const scale = size.map((cells, axis) => 1 / (cells * voxels[axis]));
  // Voxels lie around whole numbers: the first begins at -1/2.
  surroundings.toFull.value
    .set(...(image.index_to_mm as Parameters<Matrix4['set']>))
    .invert()
    .premultiply(new Matrix4().makeTranslation(0.5, 0.5, 0.5))
    .premultiply(new Matrix4().makeScale(scale[0], scale[1], scale[2]));
  surroundings.cell.value = Math.max(...voxels.map((count, axis) => count * image.spacing_mm[axis]));
}
