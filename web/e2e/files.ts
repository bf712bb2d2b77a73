/** Small files as a person might have them, made on the spot. */
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { writeNrrd } from '../src/geometry/nrrd';

const folder = mkdtempSync(join(tmpdir(), 'voxtet-e2e-'));

function kept(name: string, bytes: Uint8Array): string {
  const path = join(folder, name);
  writeFileSync(path, bytes);
  return path;
}

/** A mask of 40 mm a side around the origin of the patient's space, with one label. */
export function maskFile(name: string): string {
  const grid = { size: [8, 8, 8], indexToMm: [5, 0, 0, -20, 0, 5, 0, -20, 0, 0, 5, -20, 0, 0, 0, 1] };
  return kept(name, writeNrrd(grid, new Uint8Array(512).fill(7)));
}

/** Labels of one's own making, in the middle of the patient's space. */
export function labelledFile(
  name: string,
  size: readonly [number, number, number],
  spacing: readonly [number, number, number],
  labelAt: (i: number, j: number, k: number) => number,
): string {
  const [x, y, z] = spacing;
  const [ox, oy, oz] = size.map((n, axis) => (-n * spacing[axis]) / 2);
  const voxels = new Uint8Array(size[0] * size[1] * size[2]);
  voxels.forEach((_, v) => {
    const row = Math.floor(v / size[0]);
    voxels[v] = labelAt(v % size[0], row % size[1], Math.floor(row / size[1]));
  });
  const indexToMm = [x, 0, 0, ox, 0, y, 0, oy, 0, 0, z, oz, 0, 0, 0, 1];
  return kept(name, writeNrrd({ size: [...size], indexToMm }, voxels));
}

/** The same with label 1 alone. */
export function bodyFile(
  name: string,
  size: readonly [number, number, number],
  spacing: readonly [number, number, number],
  inside: (i: number, j: number, k: number) => boolean,
): string {
  return labelledFile(name, size, spacing, (i, j, k) => Number(inside(i, j, k)));
}

/** Two segments in layers of their own, as 3D Slicer writes them: all of `inner` lies in `outer`. */
export function layeredFile(name: string): string {
  const header = [
    'NRRD0004',
    'type: unsigned char',
    'dimension: 4',
    'space: left-posterior-superior',
    'sizes: 2 24 24 24',
    'space directions: none (1,0,0) (0,1,0) (0,0,1)',
    'kinds: list domain domain domain',
    'encoding: raw',
    'space origin: (0,0,0)',
    ...['inner', 'outer'].flatMap((segment, layer) => [
      `Segment${layer}_ID:=S${layer}`,
      `Segment${layer}_Name:=${segment}`,
      `Segment${layer}_LabelValue:=1`,
      `Segment${layer}_Layer:=${layer}`,
    ]),
  ];
  const voxels = new Uint8Array(2 * 24 ** 3);
  for (let voxel = 0; voxel < 24 ** 3; voxel++) {
    const [i, j, k] = [voxel % 24, Math.floor(voxel / 24) % 24, Math.floor(voxel / 576)];
    const radius = Math.hypot(i - 11.5, j - 11.5, k - 11.5);
    voxels.set([Number(radius < 5), Number(radius < 9)], 2 * voxel);
  }
  return kept(name, Buffer.concat([Buffer.from(header.join('\n') + '\n\n'), voxels]));
}

/** A NIfTI-1 image of one edge length over 400 mm a side. */
export function sizeImage(name: string, edgeMm: number): string {
  const size = 10;
  const bytes = Buffer.alloc(352 + 4 * size ** 3);
  bytes.writeInt32LE(348, 0);
  [3, size, size, size, 1, 1, 1, 1].forEach((n, i) => bytes.writeInt16LE(n, 40 + 2 * i));
  bytes.writeInt16LE(16, 70); // float32
  bytes.writeInt16LE(32, 72);
  [1, 40, 40, 40].forEach((x, i) => bytes.writeFloatLE(x, 76 + 4 * i));
  bytes.writeFloatLE(352, 108);
  bytes.writeFloatLE(1, 112);
  bytes.writeInt8(2, 123); // mm
  bytes.writeInt16LE(1, 254); // sform: scanner
  [40, 0, 0, -200, 0, 40, 0, -200, 0, 0, 40, -200].forEach((x, i) => bytes.writeFloatLE(x, 280 + 4 * i));
  bytes.write('n+1\0', 344, 'latin1');
  for (let voxel = 0; voxel < size ** 3; voxel++) bytes.writeFloatLE(edgeMm, 352 + 4 * voxel);
  return kept(name, bytes);
}

/** The same labels as a DICOM segmentation object and as NRRD, written without us; null where pydicom is missing. */
export function dicomSegmentation(): { dicom: string; nrrd: string } | null {
  const script = join(dirname(fileURLToPath(import.meta.url)), 'make_dicom_seg.py');
  if (spawnSync('/usr/bin/python3', ['-c', 'import pydicom, numpy']).status !== 0) return null;
  execFileSync('/usr/bin/python3', [script, folder]);
  return { dicom: join(folder, 'heart.dcm'), nrrd: join(folder, 'heart.nrrd') };
}

export function textFile(name: string, text: string): string {
  return kept(name, Buffer.from(text));
}

/** Frames of openCARP in which all points have one value, `interval` ms apart; shorts of half a unit, big-endian. */
export function igbFile(name: string, points: number, frames: readonly number[], interval: number): string {
  const header =
    `x:${points} y:1 z:1 t:${frames.length} type:short systeme:big_endian\r\n` +
    `facteur:0.5 zero:0 inc_t:${interval} unites:mV unites_t:ms\r\n`;
  const bytes = Buffer.alloc(1024 + 2 * points * frames.length, ' ');
  bytes.write(header, 'latin1');
  bytes.write('\f', 1023, 'latin1');
  frames.forEach((value, k) => {
    for (let i = 0; i < points; i++) bytes.writeInt16BE(2 * value, 1024 + 2 * (k * points + i));
  });
  return kept(name, bytes);
}

/** openCARP's files of a bar of 24 x 8 x 8 mm: label 2 in its second half, fibres along it. */
export function carpBar(name: string): string[] {
  const [nx, ny, nz] = [12, 4, 4];
  const point = (i: number, j: number, k: number) => i + (nx + 1) * (j + (ny + 1) * k);
  const points: string[] = [];
  const elements: string[] = [];
  for (let k = 0; k <= nz; k++)
    for (let j = 0; j <= ny; j++)
      for (let i = 0; i <= nx; i++) points.push(`${2000 * i} ${2000 * j} ${2000 * k}`);
  // Kuhn's six tetrahedra of a cube: the ways from its first corner to its last.
  const ways = ['012', '120', '201', '021', '210', '102'];
  for (let k = 0; k < nz; k++)
    for (let j = 0; j < ny; j++)
      for (let i = 0; i < nx; i++)
        ways.forEach((way, w) => {
          const at = [i, j, k];
          const corners = [point(i, j, k)];
          for (const axis of way) {
            at[Number(axis)]++;
            corners.push(point(at[0], at[1], at[2]));
          }
          if (w > 2) corners.push(...corners.splice(2, 2).reverse());
          elements.push(`Tt ${corners.join(' ')} ${i < nx / 2 ? 1 : 2}`);
        });
  return [
    textFile(`${name}.elem`, `${elements.length}\n${elements.join('\n')}\n`),
    textFile(`${name}.pts`, `${points.length}\n${points.join('\n')}\n`),
    textFile(`${name}.lon`, `1\n${'1 0 0\n'.repeat(elements.length)}`),
  ];
}
