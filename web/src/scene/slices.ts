import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  Group,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  RGBAFormat,
  SRGBColorSpace,
  UnsignedByteType,
  Vector3,
} from 'three';

export interface SliceGrid {
  size: readonly number[];
  /** 4×4, row-major. */
  indexToMm: readonly number[];
}

/** Writes RGBA of grid point `index` to out[at..at+3]. */
export type SlicePainter = (index: number, out: Uint8Array, at: number) => void;

/** Three planes through a grid, across its own axes, at the given fractions of its size. */
export function buildSlices(grid: SliceGrid, places: readonly number[], paint: SlicePainter): Group {
  const group = new Group();
  const toMm = new Matrix4().set(...(grid.indexToMm as Parameters<Matrix4['set']>));
  const stride = [1, grid.size[0], grid.size[0] * grid.size[1]];
  for (let axis = 0; axis < 3; axis++) {
    const u = (axis + 1) % 3;
    const v = (axis + 2) % 3;
    const at = Math.round(places[axis] * (grid.size[axis] - 1));
    const pixels = new Uint8Array(4 * grid.size[u] * grid.size[v]);
    for (let j = 0; j < grid.size[v]; j++) {
      for (let i = 0; i < grid.size[u]; i++) {
        paint(at * stride[axis] + i * stride[u] + j * stride[v], pixels, 4 * (i + grid.size[u] * j));
      }
    }
    const texture = new DataTexture(pixels, grid.size[u], grid.size[v], RGBAFormat, UnsignedByteType);
    texture.magFilter = NearestFilter;
    texture.minFilter = NearestFilter;
    texture.colorSpace = SRGBColorSpace;
    texture.needsUpdate = true;

    const corners: number[] = [];
    for (const [a, b] of [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
    ]) {
      const index = [0, 0, 0];
      index[axis] = at;
      index[u] = a * grid.size[u] - 0.5;
      index[v] = b * grid.size[v] - 0.5;
      corners.push(...new Vector3(...index).applyMatrix4(toMm).toArray());
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
    geometry.setAttribute('uv', new BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    group.add(
      new Mesh(
        geometry,
        new MeshBasicMaterial({ map: texture, side: DoubleSide, alphaTest: 0.02, transparent: true }),
      ),
    );
  }
  return group;
}

export function disposeSlices(group: Group): void {
  for (const child of group.children) {
    const mesh = child as Mesh<BufferGeometry, MeshBasicMaterial>;
    mesh.geometry.dispose();
    mesh.material.map?.dispose();
    mesh.material.dispose();
  }
}
