/** The 3-D view: follows the store, draws when it changes. The only folder that knows three.js. */
import { effect, untracked } from '@preact/signals';
import {
  BufferAttribute,
  BufferGeometry,
  Mesh,
  Raycaster,
  Vector2,
  Vector3,
  type Group,
  type RawShaderMaterial,
} from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import type { StageName, TetArrays, Vec3 } from '../engine/contract';
import { colourTable, rgbOf } from '../geometry/colours';
import { robustRange, type Faces } from '../geometry/faces';
import { nameOf, volume } from '../store/input';
import { recipe } from '../store/recipe';
import { shownResult } from '../store/results';
import { stages } from '../store/run';
import {
  brush,
  colourOf,
  command,
  cut,
  dark,
  focusTet,
  hiddenLabels,
  legend,
  marked,
  picked,
  showEdges,
  slicePlaces,
  stageShown,
} from '../store/view';
import { pointsOf, surfaceBody, tetBody, type Body } from './body';
import { elementMaterial } from './element_material';
import { lookedUpLines } from './looked_up';
import { buildMarkers, disposeMarkers, sightOf } from './markers';
import { addScaleBar, addTriad } from './overlay';
import { addRegions } from './regions';
import { buildSlices, disposeSlices } from './slices';
import { Viewer } from './viewer';

type ElementMesh = Mesh<BufferGeometry, RawShaderMaterial>;

function geometryOf(faces: Faces): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(faces.positions, 3));
  geometry.setAttribute('colour', new BufferAttribute(faces.colours, 3, true));
  if (faces.normals) geometry.setAttribute('normal', new BufferAttribute(faces.normals, 3));
  return geometry;
}

/** Offset of the cutting plane along its normal, from the fraction of the body's extent. */
function planeOffset(viewer: Viewer, normal: Vec3, place: number): number {
  let lo = Infinity;
  let hi = -Infinity;
  const { min, max } = viewer.bounds;
  for (let corner = 0; corner < 8; corner++) {
    const along =
      normal[0] * (corner & 1 ? max.x : min.x) +
      normal[1] * (corner & 2 ? max.y : min.y) +
      normal[2] * (corner & 4 ? max.z : min.z);
    lo = Math.min(lo, along);
    hi = Math.max(hi, along);
  }
  return lo + place * (hi - lo);
}

function tetCentre(mesh: TetArrays, tet: number): { centre: Vector3; size: number } {
  const corners = [0, 1, 2, 3].map((k) => new Vector3().fromArray(mesh.points, 3 * mesh.tets[4 * tet + k]));
  const centre = corners.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(4);
  return { centre, size: Math.max(...corners.map((p) => p.distanceTo(corners[0]))) };
}

export function mountScene(container: HTMLElement): () => void {
  const viewer = new Viewer(container);
  addTriad(viewer, container);
  addScaleBar(viewer, container);
  const stopRegions = addRegions(viewer);

  const opaque = { flat: elementMaterial({ smooth: false }), smooth: elementMaterial({ smooth: true }) };
  const glass = elementMaterial({ smooth: false, ghost: true });
  const body: ElementMesh = new Mesh(new BufferGeometry(), opaque.flat);
  const ghost: ElementMesh = new Mesh(new BufferGeometry(), glass);
  ghost.renderOrder = 1;
  body.frustumCulled = ghost.frustumCulled = false;
  viewer.add(body);
  viewer.add(ghost);
  let slices: Group | null = null;
  let shown: { stage: StageName; faces: Faces } | null = null;
  let tree: MeshBVH | null = null;

  const clear = () => {
    body.visible = ghost.visible = false;
    shown = null;
    tree = null;
    if (slices) {
      viewer.scene.remove(slices);
      disposeSlices(slices);
      slices = null;
    }
  };

  const showBody = (stage: StageName, made: Body) => {
    body.geometry.dispose();
    body.geometry = geometryOf(made.faces);
    body.material = made.smooth ? opaque.smooth : opaque.flat;
    body.visible = true;
    ghost.geometry.dispose();
    ghost.visible = made.ghost !== undefined;
    if (made.ghost) ghost.geometry = geometryOf(made.ghost);
    shown = { stage, faces: made.faces };
    legend.value = made.legend;
  };

  const showSlices = (stage: 'volume' | 'sizing') => {
    legend.value = null;
    if (stage === 'volume') {
      const labels = shownResult('volume')?.labels;
      if (!labels || !volume.value) return;
      const hidden = hiddenLabels.value;
      const colour = colourOf.value;
      const known = new Map<number, number[]>();
      slices = buildSlices(
        { size: volume.value.size, indexToMm: volume.value.index_to_mm },
        slicePlaces.value,
        (index, out, at) => {
          const label = labels[index];
          if (label === 0 || hidden.has(label)) {
            out.set(label === 0 ? [128, 138, 150, 26] : [128, 138, 150, 70], at);
            return;
          }
          let rgb = known.get(label);
          if (!rgb) known.set(label, (rgb = rgbOf(colour(label))));
          out.set(rgb, at);
          out[at + 3] = 255;
        },
      );
    } else {
      const wish = shownResult('sizing')?.h_mm;
      const counts = untracked(() => stages.value.sizing.summary)?.counts as
        { size: Vec3; index_to_mm: number[]; min_mm: number; max_mm: number } | undefined;
      if (!wish || !counts) return;
      const table = colourTable('viridis');
      const labels = untracked(() => shownResult('volume')?.labels);
      const inside = labels?.length === wish.length ? labels : undefined;
      const [lo, hi] = inside
        ? robustRange(wish.filter((_, index) => inside[index] > 0))
        : [counts.min_mm, counts.max_mm];
      const span = hi > lo ? hi - lo : 1;
      legend.value = { title: 'Prescribed edge length', unit: 'mm', lo, hi: lo + span, map: 'viridis' };
      slices = buildSlices(
        { size: counts.size, indexToMm: counts.index_to_mm },
        slicePlaces.value,
        (index, out, at) => {
          const x = 3 * Math.max(0, Math.min(255, Math.round((255 * (wish[index] - lo)) / span)));
          out.set(table.subarray(x, x + 3), at);
          out[at + 3] = inside && inside[index] === 0 ? 60 : 255;
        },
      );
      const smooth = shownResult('smooth');
      if (smooth) {
        const outline = surfaceBody('smooth', smooth).faces;
        ghost.geometry.dispose();
        ghost.geometry = geometryOf({
          ...outline,
          colours: new Uint8Array(outline.colours.length).fill(140),
        });
        ghost.visible = true;
      }
    }
    if (slices) viewer.add(slices);
  };

  const rebuild = () => {
    const stage = stageShown.value;
    clear();
    const points = pointsOf(stage);
    if (points && points.length > 0) viewer.setBounds(points);
    if (stage === 'volume' || stage === 'sizing') {
      showSlices(stage);
    } else if (stage === 'surface' || stage === 'smooth' || stage === 'remesh') {
      const mesh = shownResult(stage);
      if (mesh) showBody(stage, surfaceBody(stage, mesh));
      else legend.value = null;
    } else {
      const mesh = shownResult('optimise');
      if (!mesh) {
        legend.value = null;
        return;
      }
      const { on, normal, place } = cut.value;
      const plane = on ? { normal, offset: planeOffset(viewer, normal, place) } : undefined;
      const focus = focusTet.value;
      const near = focus === null ? undefined : tetCentre(mesh, focus);
      const made = tetBody(
        mesh,
        near ? undefined : plane,
        near && { centre: near.centre.toArray(), radius: 2.2 * near.size },
      );
      if (focus !== null) highlight(made.faces, focus);
      showBody(stage, made);
      const range = untracked(() => brush.value);
      if (range && range.shown !== made.count) brush.value = { ...range, shown: made.count };
    }
  };

  const clipSurface = () => {
    const { on, normal, place } = cut.value;
    const whole = stageShown.value === 'optimise' || stageShown.value === 'quality';
    for (const material of [opaque.flat, opaque.smooth]) {
      const plane = material.uniforms.clipPlane.value;
      if (on && !whole) plane.set(...normal, planeOffset(viewer, normal, place));
      else plane.set(0, 0, 0, 1);
    }
  };

  const stops = [
    effect(() => {
      rebuild();
      clipSurface();
      viewer.invalidate();
    }),
    effect(() => {
      const strength = showEdges.value ? 1 : 0;
      opaque.flat.uniforms.edgeStrength.value = 0.55 * strength;
      opaque.smooth.uniforms.edgeStrength.value = 0.35 * strength;
      glass.uniforms.opacity.value = dark.value ? 0.13 : 0.1;
      viewer.invalidate();
    }),
    effect(() => {
      const order = command.value;
      if (!order) return;
      untracked(() => obey(order));
      command.value = null;
    }),
    effect(() => {
      const tet = focusTet.value;
      const mesh = untracked(() => shownResult('optimise'));
      if (tet === null || !mesh || 4 * tet >= mesh.tets.length) return;
      const { centre, size } = tetCentre(mesh, tet);
      viewer.flyTo(centre, 2.6 * size);
      untracked(() => describe(stageShown.value, tet));
    }),
    effect(() => {
      const place = marked.value;
      if (!place) return;
      const group = buildMarkers(place, shownResult('remesh'), dotRadius());
      viewer.add(group);
      viewer.invalidate();
      return () => {
        viewer.scene.remove(group);
        disposeMarkers(group);
        viewer.invalidate();
      };
    }),
  ];

  function dotRadius(): number {
    return viewer.bounds.getSize(new Vector3()).length() / 120;
  }

  function highlight(faces: Faces, tet: number): void {
    faces.owners.forEach((owner, face) => {
      if (owner !== tet) return;
      for (let c = 0; c < 3; c++) faces.colours.set([255, 196, 0], 9 * face + 3 * c);
    });
  }

  function obey(order: NonNullable<typeof command.value>): void {
    switch (order.kind) {
      case 'fit':
        viewer.fitFromFront();
        break;
      case 'look':
        viewer.look(order.from);
        break;
      case 'marked':
        if (marked.value) {
          const { center, radius } = sightOf(marked.value, shownResult('remesh'), dotRadius());
          viewer.flyTo(center, radius);
        }
        break;
      case 'cut_facing_me': {
        const towards = viewer.camera.position.clone().sub(viewer.controls.target).normalize();
        cut.value = { ...cut.value, on: true, normal: towards.toArray() };
        break;
      }
    }
  }

  function describe(stage: StageName, element: number): void {
    if (stage === 'optimise' || stage === 'quality') {
      const mesh = shownResult('optimise');
      const measures = shownResult('quality');
      if (!mesh) return;
      const lines: [string, string][] = [['Label', nameOf(mesh.labels[element])]];
      if (measures) {
        lines.push(
          [
            'Dihedral angles',
            `${measures.min_dihedral_deg[element].toFixed(1)}° to ${measures.max_dihedral_deg[element].toFixed(1)}°`,
          ],
          ['Mean edge', `${measures.edge_mm[element].toFixed(2)} mm`],
          ['Radius ratio', measures.radius_ratio[element].toFixed(3)],
          ...lookedUpLines(measures, element),
        );
      }
      picked.value = { title: `Tetrahedron ${element.toLocaleString('en')}`, lines };
    } else if (stage === 'surface' || stage === 'smooth' || stage === 'remesh') {
      const mesh = shownResult(stage);
      if (!mesh) return;
      const [behind, front] = [mesh.sides[2 * element], mesh.sides[2 * element + 1]];
      picked.value = {
        title: `Triangle ${element.toLocaleString('en')}`,
        lines: [['Between', `${nameOf(behind)} and ${nameOf(front)}`]],
      };
    }
  }

  let pressed: [number, number] | null = null;
  const canvas = viewer.renderer.domElement;
  const onDown = (event: PointerEvent) => (pressed = [event.clientX, event.clientY]);
  const onUp = (event: PointerEvent) => {
    const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4;
    pressed = null;
    if (!still || !shown || !body.visible) return;
    const box = canvas.getBoundingClientRect();
    const pointer = new Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    const caster = new Raycaster();
    caster.setFromCamera(pointer, viewer.camera);
    // The tree reorders an index of its own; positions stay as they are, three corners a face.
    tree ??= new MeshBVH(body.geometry, { indirect: true });
    const clip = body.material.uniforms.clipPlane.value as { x: number; y: number; z: number; w: number };
    const hit = tree
      .raycast(caster.ray, 2)
      .filter(({ point }) => clip.x * point.x + clip.y * point.y + clip.z * point.z <= clip.w)
      .sort((a, b) => a.distance - b.distance)[0];
    if (hit?.faceIndex === undefined || hit.faceIndex === null) {
      picked.value = null;
      return;
    }
    describe(shown.stage, shown.faces.owners[hit.faceIndex]);
    if (picked.value) {
      picked.value = {
        ...picked.value,
        lines: [
          ...picked.value.lines,
          [
            'At',
            `${hit.point
              .toArray()
              .map((x) => x.toFixed(1))
              .join(', ')} mm`,
          ],
        ],
      };
    }
  };
  canvas.addEventListener('pointerdown', onDown);
  canvas.addEventListener('pointerup', onUp);

  if (untracked(() => recipe.value && pointsOf(stageShown.value))) viewer.fitFromFront();
  return () => {
    for (const stop of stops) stop();
    stopRegions();
    clear();
    viewer.dispose();
    container.replaceChildren();
  };
}
