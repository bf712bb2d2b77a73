import type { Labels, Vec3 } from '../engine/contract';

/** Cells along the longest side of the image, about; and places that are looked at in each, along each axis. */
const cellCount = 40;
const looks = 3;

export interface Fullness {
  /** 0 where a cell is empty, 255 where it is full; the first axis is the fastest. */
  data: Uint8Array;
  size: Vec3;
  /** Voxels of a cell along each axis. */
  voxels: Vec3;
}

/** How full of some labels an image is, in cells that are about as long as wide. */
export function fullness(
  labels: Labels,
  image: { size: Vec3; spacing_mm: Vec3 },
  counts: (label: number) => boolean,
): Fullness {
  const [nx, ny, nz] = image.size;
  const longest = Math.max(...image.size.map((n, axis) => n * image.spacing_mm[axis]));
  const voxels = image.spacing_mm.map((step) => Math.max(1, Math.round(longest / cellCount / step))) as Vec3;
  const size = image.size.map((n, axis) => Math.ceil(n / voxels[axis])) as Vec3;
  const known = new Map<number, boolean>();
  const isFull = (label: number) => {
    let found = known.get(label);
    if (found === undefined) known.set(label, (found = label > 0 && counts(label)));
    return found;
  };
  /** Voxels of a cell that are looked at. */
  const places = (cell: number, axis: number, end: number) => {
    const count = Math.min(looks, voxels[axis]);
    return Array.from({ length: count }, (_, i) =>
      Math.min(end - 1, cell * voxels[axis] + Math.floor(((i + 0.5) * voxels[axis]) / count)),
    );
  };
  const data = new Uint8Array(size[0] * size[1] * size[2]);
  const columns = Array.from({ length: size[0] }, (_, cell) => places(cell, 0, nx));
  let at = 0;
  for (let z = 0; z < size[2]; z++) {
    const layers = places(z, 2, nz);
    for (let y = 0; y < size[1]; y++) {
      const rows = layers.flatMap((k) => places(y, 1, ny).map((j) => nx * (j + ny * k)));
      for (const column of columns) {
        let full = 0;
        for (const row of rows) for (const i of column) if (isFull(labels[row + i])) full++;
        data[at++] = Math.round((255 * full) / (rows.length * column.length));
      }
    }
  }
  return { data, size, voxels };
}

/**
 * How open each cell is to its surroundings: 255 where nothing is in the way along any of the 26 directions to its
 * neighbours and on to the end of the grid. Each direction is one sweep, in which a cell asks the one before it.
 */
export function openness(
  { data, size }: Fullness,
  isGone: (cell: Vec3) => boolean = () => false,
): Uint8Array {
  const [nx, ny, nz] = size;
  const clear = Float32Array.from(data, (full) => 1 - full / 255);
  for (let z = 0, at = 0; z < nz; z++)
    for (let y = 0; y < ny; y++)
      for (let x = 0; x < nx; x++, at++) if (clear[at] < 1 && isGone([x, y, z])) clear[at] = 1;
  const sum = new Float32Array(data.length);
  const free = new Float32Array(data.length);
  for (let way = 0; way < 27; way++) {
    const [dx, dy, dz] = [(way % 3) - 1, (Math.floor(way / 3) % 3) - 1, Math.floor(way / 9) - 1];
    const step = dx + nx * (dy + ny * dz);
    if (step === 0) continue;
    for (let k = 0; k < nz; k++) {
      const z = dz > 0 ? nz - 1 - k : k;
      for (let j = 0; j < ny; j++) {
        const y = dy > 0 ? ny - 1 - j : j;
        const inside = z + dz >= 0 && z + dz < nz && y + dy >= 0 && y + dy < ny;
        const row = nx * (y + ny * z);
        for (let i = 0; i < nx; i++) {
          const x = dx > 0 ? nx - 1 - i : i;
          const at = row + x;
          free[at] = inside && x + dx >= 0 && x + dx < nx ? free[at + step] * clear[at + step] : 1;
          sum[at] += free[at];
        }
      }
    }
  }
  return Uint8Array.from(sum, (ways) => Math.round((255 * ways) / 26));
}
