import { BufferAttribute, type BufferGeometry } from 'three';

/** Gives a geometry its points, in the buffer that it has where they are as many as before. */
export function setPositions(geometry: BufferGeometry, positions: Float32Array): void {
  const known = geometry.getAttribute('position') as BufferAttribute | undefined;
  if (known?.array.length !== positions.length) {
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    return;
  }
  known.copyArray(positions);
  known.needsUpdate = true;
}
