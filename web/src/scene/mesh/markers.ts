import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  Sphere,
  SphereGeometry,
  Vector3,
} from 'three';
import type { ErrorPlace, SurfaceArrays } from '../../engine/contract';

/** Of no colour map and no palette of labels. */
export const markColour = 0xff00b8;
const marking = { color: markColour, depthTest: false, transparent: true, opacity: 0.85 };

function corners(surface: SurfaceArrays, triangle: number): Vector3[] {
  return [0, 1, 2].map((c) =>
    new Vector3().fromArray(surface.points, 3 * surface.triangles[3 * triangle + c]),
  );
}

/** Those of an error's triangles that the surface has. */
function trianglesOf(place: ErrorPlace, surface: SurfaceArrays | undefined): Vector3[][] {
  if (!surface || place.on !== 'triangles' || place.stage !== 'remesh') return [];
  const count = surface.triangles.length / 3;
  return place.elements.filter((triangle) => triangle < count).map((triangle) => corners(surface, triangle));
}

/** An error's triangles, or dots of this radius where they are not known; seen through everything. */
export function buildMarkers(place: ErrorPlace, surface: SurfaceArrays | undefined, radius: number): Group {
  const group = new Group();
  const triangles = trianglesOf(place, surface);
  const add = (geometry: BufferGeometry) => {
    const mesh = new Mesh(geometry, new MeshBasicMaterial({ ...marking, side: DoubleSide }));
    mesh.renderOrder = 5;
    group.add(mesh);
    return mesh;
  };
  if (triangles.length > 0) {
    const positions = Float32Array.from(triangles.flat().flatMap((point) => point.toArray()));
    add(new BufferGeometry().setAttribute('position', new BufferAttribute(positions, 3)));
  } else {
    const dot = new SphereGeometry(radius, 16, 12);
    for (const point of place.points) add(dot).position.set(...point);
  }
  return group;
}

export function disposeMarkers(group: Group): void {
  for (const mesh of group.children as Mesh<BufferGeometry, MeshBasicMaterial>[]) {
    mesh.geometry.dispose();
    mesh.material.dispose();
  }
}

/** The first of an error's places, and how much around it is worth seeing. */
export function sightOf(place: ErrorPlace, surface: SurfaceArrays | undefined, radius: number): Sphere {
  const [first] = trianglesOf(place, surface);
  if (!first) return new Sphere(new Vector3(...place.points[0]), 8 * radius);
  const sight = new Sphere().setFromPoints(first);
  sight.radius *= 6;
  return sight;
}
