/** Label volumes as NRRD files that the engine reads, and back the ones written here. */
import type { Grid } from './grid_values';
import { toMm } from './orientation';

export interface Segment {
  label: number;
  name: string;
  /** 0 to 1. */
  colour?: readonly number[];
  /** Which of a voxel's values it is in; the first where absent. */
  layer?: number;
}

/** Uncompressed, in patient space RAS. Several values a voxel are layers of segments, which may overlap. */
export function writeNrrd(
  { size, indexToMm }: Grid,
  voxels: Uint8Array | Uint16Array,
  segments: readonly Segment[] = [],
  layers = 1,
): Uint8Array<ArrayBuffer> {
  // Minus nothing would be read back as nothing, which is another number to a digest.
  const vector = (numbers: readonly number[]) => `(${numbers.map((x) => x + 0).join(',')})`;
  const column = (axis: number) => vector([0, 1, 2].map((row) => indexToMm[4 * row + axis]));
  // An axis of layers comes before those of space.
  const behind = (layered: string, plain: string) => (layers > 1 ? `${layered} ${plain}` : plain);
  const header = [
    'NRRD0004',
    `type: ${voxels instanceof Uint8Array ? 'uint8' : 'uint16'}`,
    `dimension: ${layers > 1 ? 4 : 3}`,
    'space: right-anterior-superior',
    `sizes: ${behind(String(layers), size.join(' '))}`,
    `space directions: ${behind('none', [0, 1, 2].map(column).join(' '))}`,
    `space origin: ${vector(toMm(indexToMm, [0, 0, 0]))}`,
    `kinds: ${behind('list', 'domain domain domain')}`,
    'endian: little',
    'encoding: raw',
    ...segments.flatMap(({ label, name, colour, layer = 0 }, at) => [
      `Segment${at}_Name:=${name.replace(/[\r\n]+/g, ' ')}`,
      `Segment${at}_LabelValue:=${label}`,
      `Segment${at}_Layer:=${layer}`,
      ...(colour ? [`Segment${at}_Color:=${colour.join(' ')}`] : []),
    ]),
  ].join('\n');
  const text = new TextEncoder().encode(`${header}\n\n`);
  const bytes = new Uint8Array(text.length + voxels.byteLength);
  bytes.set(text);
  bytes.set(new Uint8Array(voxels.buffer, voxels.byteOffset, voxels.byteLength), text.length);
  return bytes;
}

/** A volume of bytes that `writeNrrd` wrote; null for any other file. */
export function readOwnNrrd(bytes: Uint8Array): { grid: Grid; voxels: Uint8Array<ArrayBuffer> } | null {
  const head = new TextDecoder('latin1').decode(bytes.subarray(0, 4096));
  const end = head.indexOf('\n\n');
  const field = (name: string) => new RegExp(`^${name}: (.*)$`, 'm').exec(head.slice(0, end))?.[1] ?? '';
  const numbers = (text: string) => text.match(/[-+.\deE]+/g)?.map(Number) ?? [];
  const size = numbers(field('sizes'));
  const directions = numbers(field('space directions'));
  const origin = numbers(field('space origin'));
  const own = field('type') === 'uint8' && field('encoding') === 'raw' && field('space').startsWith('right');
  const count = size.reduce((product, n) => product * n, 1);
  if (end < 0 || !own || size.length !== 3 || directions.length !== 9 || origin.length !== 3) return null;
  if (bytes.length !== end + 2 + count) return null;
  const rows = [0, 1, 2].map((row) => [0, 1, 2].map((axis) => directions[3 * axis + row]));
  const indexToMm = [...rows.flatMap((row, i) => [...row, origin[i]]), 0, 0, 0, 1];
  return { grid: { size, indexToMm }, voxels: bytes.slice(end + 2) };
}

/** The engine's digest of a label volume: SHA-256 over its size, the affine map as floats, and the labels. */
export async function volumeDigest({ size, indexToMm }: Grid, voxels: Uint8Array): Promise<string> {
  if (!globalThis.crypto?.subtle)
    throw new Error('This page needs https: without it browsers make no digests.');
  const bytes = new Uint8Array(12 + 48 + 2 * voxels.length);
  new Int32Array(bytes.buffer, 0, 3).set(size);
  new Float32Array(bytes.buffer, 12, 12).set(indexToMm.slice(0, 12).map((x) => x + 0));
  new Uint16Array(bytes.buffer, 60).set(voxels);
  const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
  return [...hash].map((byte) => byte.toString(16).padStart(2, '0')).join('');
}
