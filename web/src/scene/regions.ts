import {
  BoxGeometry,
  BufferGeometry,
  CapsuleGeometry,
  EdgesGeometry,
  Euler,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import { effect } from '@preact/signals';
import type { Vec3 } from '../engine/contract';
import type { Region } from '../geometry/regions';
import { bodiesInView, editBody, isChosen, isPoint, type Body } from '../store/case/bodies';
import { recipe } from '../store/case/recipe';
import { bodyShown, gizmoMode } from '../store/view';
import type { Viewer } from './frame/viewer';

const degrees = 180 / Math.PI;
const rounded = (value: number) => Math.round(value * 100) / 100;
const vec3 = (v: Vector3): Vec3 => [rounded(v.x), rounded(v.y), rounded(v.z)];

/** Rotation about x, then y, then z, all fixed: Rz·Ry·Rx, which three calls ZYX. */
function boxTurn(region: Region): Euler {
  const [x, y, z] = region.axes_deg;
  return new Euler(x / degrees, y / degrees, z / degrees, 'ZYX');
}

function bodyOf(region: Region): BufferGeometry {
  switch (region.shape) {
    case 'sphere':
      return new SphereGeometry(1, 32, 20);
    case 'box':
      return new BoxGeometry(2, 2, 2);
    case 'capsule': {
      const length = new Vector3(...region.centre_mm).distanceTo(new Vector3(...region.end_mm));
      return new CapsuleGeometry(region.radius_mm, length, 8, 24);
    }
  }
}

function wireOf(region: Region, body: BufferGeometry): BufferGeometry {
  if (region.shape === 'box') return new EdgesGeometry(body);
  const points: Vector3[] = [];
  const circle = (radius: number, place: (a: number, b: number) => Vector3) => {
    for (let i = 0; i < 64; i++) {
      for (const step of [i, i + 1]) {
        const angle = (step / 64) * 2 * Math.PI;
        points.push(place(radius * Math.cos(angle), radius * Math.sin(angle)));
      }
    }
  };
  if (region.shape === 'sphere') {
    circle(1, (a, b) => new Vector3(a, b, 0));
    circle(1, (a, b) => new Vector3(a, 0, b));
    circle(1, (a, b) => new Vector3(0, a, b));
  } else {
    const half = new Vector3(...region.centre_mm).distanceTo(new Vector3(...region.end_mm)) / 2;
    circle(region.radius_mm, (a, b) => new Vector3(a, half, b));
    circle(region.radius_mm, (a, b) => new Vector3(a, -half, b));
  }
  return new BufferGeometry().setFromPoints(points);
}

function place(object: Group, region: Region): void {
  const centre = new Vector3(...region.centre_mm);
  object.scale.set(1, 1, 1);
  object.quaternion.identity();
  if (region.shape === 'sphere') object.scale.setScalar(region.radius_mm);
  if (region.shape === 'box') {
    object.scale.set(...region.half_size_mm);
    object.quaternion.setFromEuler(boxTurn(region));
  }
  if (region.shape === 'capsule') {
    const end = new Vector3(...region.end_mm);
    const along = end.clone().sub(centre);
    if (along.lengthSq() > 0)
      object.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), along.normalize()));
    centre.add(end).multiplyScalar(0.5);
  }
  object.position.copy(centre);
}

/** The place of a body that was dragged. */
function placeOf(object: Group, region: Region, startRadius: number): Partial<Region> {
  if (region.shape === 'capsule') {
    const middle = new Vector3(...region.centre_mm).add(new Vector3(...region.end_mm)).multiplyScalar(0.5);
    const shift = object.position.clone().sub(middle);
    return {
      end_mm: vec3(new Vector3(...region.end_mm).add(shift)),
      centre_mm: vec3(new Vector3(...region.centre_mm).add(shift)),
    };
  }
  const centre_mm = vec3(object.position);
  if (region.shape === 'sphere') {
    // A sphere scales by whichever handle was pulled furthest.
    const { x, y, z } = object.scale;
    const pulled = [x, y, z].sort((a, b) => Math.abs(b - startRadius) - Math.abs(a - startRadius))[0];
    return { centre_mm, radius_mm: Math.max(0.1, rounded(Math.abs(pulled))) };
  }
  const turn = new Euler().setFromQuaternion(object.quaternion, 'ZYX');
  return {
    centre_mm,
    half_size_mm: vec3(object.scale).map((half) => Math.max(0.1, Math.abs(half))) as Vec3,
    axes_deg: [rounded(turn.x * degrees), rounded(turn.y * degrees), rounded(turn.z * degrees)],
  };
}

/** What is chosen is brighter, in the colour of its kind. */
const colours = { region: 0x0d8f97, stimulus: 0xc2188f, electrode: 0x2f7d32 };
const quiet = { region: 0x7a8794, stimulus: 0xb0679c, electrode: 0x6d9470 };

/** Regions, stimuli and electrodes as glassy bodies; the chosen one carries a gizmo whose drags are edits of the recipe. */
export function addRegions(viewer: Viewer): () => void {
  const root = new Group();
  viewer.add(root);
  const gizmo = new TransformControls(viewer.camera, viewer.element);
  gizmo.size = 1.1;
  gizmo.setColors('#c9473f', '#2f8f57', '#3570c4', '#e0a100');
  viewer.add(gizmo.getHelper());
  let dragCount = 0;
  let dragging = false;
  let startRadius = 1;
  const chosenBody = () => bodiesInView(recipe.value).find(isChosen);
  gizmo.addEventListener('dragging-changed', (event) => {
    dragging = event.value as boolean;
    viewer.controls.enabled = !dragging;
    if (dragging) {
      dragCount++;
      startRadius = chosenBody()?.region.radius_mm ?? 1;
    }
  });
  gizmo.addEventListener('change', () => viewer.invalidate());
  gizmo.addEventListener('objectChange', () => {
    const body = chosenBody();
    const object = gizmo.object as Group | undefined;
    if (!body || !object) return;
    const verb = { translate: 'Move', rotate: 'Turn', scale: 'Resize' }[gizmo.mode];
    const change = placeOf(object, body.region, startRadius);
    editBody(`${verb} ${body.kind}`, body, change, `drag ${dragCount}`, Infinity);
  });

  const rebuild = (bodies: readonly Body[]) => {
    for (const child of root.children) {
      child.traverse((part) => {
        if (part instanceof Mesh || part instanceof LineSegments) {
          part.geometry.dispose();
          part.material.dispose();
        }
      });
    }
    root.clear();
    for (const { kind, index, region } of bodies) {
      const object = new Group();
      const body = bodyOf(region);
      const chosen = isChosen({ kind, index });
      const colour = (chosen ? colours : quiet)[kind];
      const glass = new MeshBasicMaterial({
        color: colour,
        transparent: true,
        opacity: chosen ? 0.16 : 0.08,
        depthWrite: false,
      });
      object.add(new Mesh(body, glass));
      // Twice: crisp where it is in front, faint where the body hides it.
      const wire = wireOf(region, body);
      object.add(
        new LineSegments(wire, new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.95 })),
      );
      const hidden = new LineBasicMaterial({
        color: colour,
        transparent: true,
        opacity: chosen ? 0.5 : 0.25,
        depthTest: false,
      });
      const behind = new LineSegments(wire, hidden);
      behind.renderOrder = 3;
      object.add(behind);
      place(object, region);
      root.add(object);
    }
  };

  const stop = effect(() => {
    const bodies = bodiesInView(recipe.value);
    void bodyShown.value;
    const mode = gizmoMode.value;
    const chosen = bodies.find(isChosen);
    if (dragging) {
      const object = gizmo.object as Group | undefined;
      if (object && chosen?.region.shape === 'sphere') object.scale.setScalar(chosen.region.radius_mm);
      viewer.invalidate();
      return;
    }
    gizmo.detach();
    rebuild(bodies);
    if (chosen) {
      const { shape } = chosen.region;
      const may = shape === 'box' || (shape === 'sphere' && mode === 'scale' && !isPoint(chosen.kind));
      gizmo.setMode(may ? mode : 'translate');
      gizmo.setSpace(shape === 'box' && mode !== 'translate' ? 'local' : 'world');
      gizmo.attach(root.children[bodies.indexOf(chosen)]);
    }
    viewer.invalidate();
  });
  return () => {
    stop();
    gizmo.detach();
    gizmo.dispose();
  };
}
