import {
  DataTexture,
  FloatType,
  IntType,
  RedFormat,
  RedIntegerFormat,
  RGBAFormat,
  RGBAIntegerFormat,
  UnsignedByteType,
  UnsignedIntType,
  type PixelFormat,
  type TextureDataType,
} from 'three';
import { colourTable, rgbOf, type ColourMapName } from '../../geometry/colours';
import { inRows, texelsPerRow } from '../../geometry/rows';

/** Labels stand in rows of this many. */
const labelsPerRow = 256;

type Texels = Parameters<typeof inRows>[0];

function formatOf(array: Texels, channels: 1 | 4): [PixelFormat, TextureDataType] {
  if (array instanceof Float32Array) return [channels === 1 ? RedFormat : RGBAFormat, FloatType];
  const format = channels === 1 ? RedIntegerFormat : RGBAIntegerFormat;
  if (array instanceof Uint32Array) return [format, UnsignedIntType];
  return [format, array instanceof Int32Array ? IntType : UnsignedByteType];
}

/** A long array as a texture of rows, one or four numbers a texel. */
export function arrayTexture(array: ArrayLike<number>, channels: 1 | 4): DataTexture {
  const data = inRows(array as Texels, channels);
  const rows = data.length / channels / texelsPerRow;
  const texture = new DataTexture(data as never, texelsPerRow, rows, ...formatOf(data, channels));
  texture.needsUpdate = true;
  return texture;
}

/** Puts another array of the same length and kind into such a texture. */
export function refill(texture: DataTexture, array: ArrayLike<number>): void {
  texture.image.data = inRows(array as Texels, 1) as never;
  texture.needsUpdate = true;
}

export function pointTexture(points: Float32Array): DataTexture {
  const wide = new Float32Array((points.length / 3) * 4);
  for (let i = 0, j = 0; i < points.length; i += 3, j += 4) {
    wide[j] = points[i];
    wide[j + 1] = points[i + 1];
    wide[j + 2] = points[i + 2];
  }
  return arrayTexture(wide, 4);
}

function labelRows(largest: number): number {
  return Math.floor(largest / labelsPerRow) + 1;
}

/** The colour of each label up to the largest; the alpha of background and of hidden labels is lower. */
export function paletteTexture(
  largest: number,
  colour: (label: number) => string,
  hidden: ReadonlySet<number>,
): DataTexture {
  const rows = labelRows(largest);
  const data = new Uint8Array(4 * labelsPerRow * rows);
  data.set([128, 138, 150, 26]);
  for (let label = 1; label <= largest; label++) {
    data.set(hidden.has(label) ? [128, 138, 150, 70] : [...rgbOf(colour(label)), 255], 4 * label);
  }
  const texture = new DataTexture(data, labelsPerRow, rows, RGBAFormat, UnsignedByteType);
  texture.needsUpdate = true;
  return texture;
}

/** Three numbers a label. */
export function labelTexture(largest: number, vectors: ReadonlyMap<number, ArrayLike<number>>): DataTexture {
  const rows = labelRows(largest);
  const data = new Float32Array(4 * labelsPerRow * rows);
  for (const [label, vector] of vectors) data.set(vector, 4 * label);
  const texture = new DataTexture(data, labelsPerRow, rows, RGBAFormat, FloatType);
  texture.needsUpdate = true;
  return texture;
}

export function scaleTexture(map: ColourMapName): DataTexture {
  const table = colourTable(map);
  const data = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) data.set([...table.subarray(3 * i, 3 * i + 3), 255], 4 * i);
  const texture = new DataTexture(data, 256, 1, RGBAFormat, UnsignedByteType);
  texture.needsUpdate = true;
  return texture;
}
