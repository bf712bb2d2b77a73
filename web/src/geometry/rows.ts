/** Long arrays stand in textures as rows of this many texels; the shaders count on it. */
export const texelsPerRow = 2048;

type Texels =
  | Float32Array<ArrayBuffer>
  | Uint32Array<ArrayBuffer>
  | Int32Array<ArrayBuffer>
  | Uint8Array<ArrayBuffer>;
type Maker<T> = new (from: number | ArrayBuffer, offset?: number, length?: number) => T;

function wholeRows(length: number, perRow: number): number {
  return Math.max(1, Math.ceil(length / perRow)) * perRow;
}

/** The same numbers, with room behind them for a texture to have whole rows of up to four numbers a texel. */
export function withRoom<T extends Texels>(array: T): T {
  const roomy = new (array.constructor as Maker<T>)(wholeRows(array.length, 4 * texelsPerRow));
  roomy.set(array);
  return roomy.subarray(0, array.length) as T;
}

/** An array in whole rows of a texture; itself where there is room behind it, else a copy. */
export function inRows<T extends Texels>(array: T, channels: 1 | 4): T {
  const length = wholeRows(array.length, channels * texelsPerRow);
  const Rows = array.constructor as Maker<T>;
  const { buffer, byteOffset, BYTES_PER_ELEMENT } = array;
  if (byteOffset + length * BYTES_PER_ELEMENT <= buffer.byteLength)
    return new Rows(buffer, byteOffset, length);
  const rows = new Rows(length);
  rows.set(array);
  return rows;
}

/** For shaders, which cannot tell what is not a number: `none` in its place. */
export function withNone(values: Float32Array, none: number): Float32Array<ArrayBuffer> {
  return Float32Array.from(values, (value) => (Number.isNaN(value) ? none : value));
}
