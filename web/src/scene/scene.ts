/** The view: follows the store, draws when it changes. The only folder that knows three.js. */
import { batch, computed, effect, untracked } from '@preact/signals';
import { Vector3 } from 'three';
import type { StageName, Vec3 } from '../engine/contract';
import { freeSide } from '../geometry/free_side';
import { toIndex } from '../geometry/orientation';
import { borderTriangles } from '../geometry/section';
import { movedMesh } from '../store/run/beat/motion';
import { pinned, pinnedArrays } from '../store/run/compare';
import { addRegion, bodiesOf } from '../store/case/bodies';
import { volume, voxelCount } from '../store/case/input';
import { meshedLabels } from '../store/case/labels';
import { recipe } from '../store/case/recipe';
import { tellError } from '../store/run/engine';
import { mayStimulate } from '../store/run/frames';
import { pointsOf, shownResult } from '../store/run/results';
import {
  bodyLegend,
  command,
  cut,
  dark,
  explode,
  fibreStyle,
  focusTet,
  hiddenLabels,
  labelsShown,
  layout,
  legend,
  marked,
  picked,
  sceneMounted,
  seeThrough,
  showEdges,
  sliceLegend,
  slicePlaces,
  stageShown,
  stimulating,
} from '../store/view';
import { BodyView } from './mesh/body_view';
import { Canvas } from './frame/canvas';
import { describe } from './describe';
import { buildMarkers, disposeMarkers, sightOf } from './mesh/markers';
import { addScaleBar, addTriad } from './frame/overlay';
import { surfaceBody } from './mesh/colouring';
import { pickAt, type Hit } from './mesh/pick';
import { cutSurroundings, forgetSurroundings, setSurroundings } from './frame/surroundings';
import { addSlices } from './slices/slices_view';
import type { Plane } from './mesh/tet_model';
import { followTets, isOnTets, tetCentre, type TetSource } from './mesh/tets_view';
import { Twin } from './frame/twin';
import { Viewer } from './frame/viewer';
import { WarmUp } from './warm_up';

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

function isSurface(stage: StageName): stage is 'surface' | 'smooth' | 'remesh' {
  return stage === 'surface' || stage === 'smooth' || stage === 'remesh';
}

const onTets = () => isOnTets(stageShown.value);

function tetsShown(): TetSource | null {
  const mesh = onTets() ? shownResult('optimise') : undefined;
  return mesh ? { mesh, measures: shownResult('quality') } : null;
}

/** A part of the view whose code is fetched when it is first needed; `load` gives what adds it. */
function whenNeeded(isNeeded: () => boolean, load: () => Promise<() => () => void>): () => void {
  let stopped = false;
  let stopPart: (() => void) | undefined;
  const needed = computed(isNeeded);
  const stopWaiting = effect(() => {
    if (!needed.value || stopPart) return;
    load().then((add) => {
      if (!stopped) stopPart ??= add();
    }, tellError);
  });
  return () => {
    stopped = true;
    stopWaiting();
    stopPart?.();
  };
}

/** As text, so that other edits of the recipe do not count. */
const meshedText = computed(() => [...meshedLabels.value].join());

export function mountScene(container: HTMLElement): () => void {
  const canvas = new Canvas(container);
  const panes = document.createElement('div');
  panes.className = 'panes';
  container.append(panes);
  const main = document.createElement('div');
  main.className = 'pane model';
  panes.append(main);
  const viewer = new Viewer(canvas, main);
  addTriad(viewer, main);
  addScaleBar(viewer, main);
  const slices = addSlices(canvas, viewer, panes);
  const warmUp = new WarmUp(canvas.renderer, slices.material);
  canvas.holdUntil(warmUp.ready);
  const body = new BodyView();
  viewer.add(body.group);
  const beside = document.createElement('div');
  beside.className = 'pane twin';
  panes.append(beside);
  const twin = new Twin(canvas, viewer, beside);
  const other = new BodyView();
  twin.scene.add(other.group);
  for (const [pane, text] of [
    [main, 'This run'],
    [beside, 'Pinned'],
  ] as const) {
    const name = document.createElement('span');
    name.className = 'run-name';
    name.textContent = text;
    pane.append(name);
  }

  const planeNow = (): Plane | null => {
    const { on, flat, normal, place } = cut.value;
    // The ends of the way are those of the body that is shown.
    void pointsOf(stageShown.value);
    if (!on || (focusTet.value !== null && onTets())) return null;
    return { normal, offset: planeOffset(viewer, normal, place), flat };
  };

  const stops = [
    whenNeeded(
      () => bodiesOf(recipe.value).length > 0,
      async () => {
        const { addRegions } = await import('./regions');
        return () => addRegions(viewer);
      },
    ),
    whenNeeded(
      () => fibreStyle.value !== 'none',
      async () => {
        const { addFibres } = await import('./mesh/fibres_view');
        return () => addFibres(viewer, body.group, planeNow, onTets);
      },
    ),
    whenNeeded(
      () => picked.value !== null,
      async () => {
        const { addOutline } = await import('./mesh/outline');
        return () => addOutline(viewer);
      },
    ),
    effect(() => {
      body.setSeeThrough(fibreStyle.value !== 'none' && seeThrough.value);
      canvas.invalidate();
    }),
    effect(() => {
      main.dataset.tool = stimulating.value && mayStimulate.value ? 'stimulate' : '';
    }),
    effect(() => {
      panes.dataset.layout = layout.value;
      canvas.invalidate();
    }),
    effect(() => {
      const stage = stageShown.value;
      const points = pointsOf(stage);
      main.dataset.body = String(points !== undefined);
      if (points && points.length > 0) viewer.setBounds(points);
      canvas.invalidate();
      if (tetsShown()) return;
      body.clear();
      slices.show(null);
      legend.value = null;
      labelsShown.value = [];
      const surface = isSurface(stage) && shownResult(stage);
      if (surface) {
        const made = surfaceBody(surface);
        body.showSurface(made);
        slices.show({ borders: () => made.faces.positions });
        legend.value = made.legend;
        labelsShown.value = made.labels;
      } else if (stage === 'sizing') {
        const smooth = shownResult('smooth');
        if (smooth) body.showSurface(surfaceBody(smooth), true);
      } else if (stage === 'volume') {
        const labels = volume.value?.labels.map(({ label }) => label) ?? [];
        labelsShown.value = labels.filter((label) => !hiddenLabels.value.has(label));
      }
    }),
    effect(() => {
      const labels = shownResult('volume')?.labels;
      const image = untracked(() => volume.value);
      void meshedText.value;
      const meshed = untracked(() => meshedLabels.value);
      const hidden = hiddenLabels.value;
      const counts = (label: number) => meshed.has(label) && !hidden.has(label);
      if (image && labels?.length === untracked(() => voxelCount.value))
        setSurroundings(labels, image, counts);
      else forgetSurroundings();
      cutSurroundings(untracked(planeNow));
      canvas.invalidate();
    }),
    effect(() => cutSurroundings(planeNow())),
    followTets(canvas, body, {
      source: tetsShown,
      plane: planeNow,
      leads: true,
      onModel: (model, mesh) =>
        slices.show({
          borders: () => borderTriangles(movedMesh.value ?? mesh, hiddenLabels.value),
          elements: { mesh, edges: (image) => model.section(image) },
        }),
    }),
    followTets(canvas, other, {
      source: () => (layout.value === 'compare' ? pinnedArrays() : null),
      plane: planeNow,
      leads: false,
    }),
    effect(() => {
      if (!pinned.value) other.clear();
    }),
    effect(() => {
      for (const one of [body, other]) one.setLook(showEdges.value, dark.value ? 0.13 : 0.1);
      canvas.invalidate();
    }),
    effect(() => {
      const order = command.value;
      if (!order) return;
      untracked(() => obey(order));
      command.value = null;
    }),
    effect(() => {
      const tet = focusTet.value;
      const mesh = movedMesh.peek();
      if (tet === null || !mesh || 4 * tet >= mesh.tets.length) return;
      untracked(() => {
        const { centre, size } = tetCentre(mesh, tet);
        const direction = new Vector3(...freeSide(mesh, tet, hiddenLabels.value));
        viewer.flyTo(tetCentre(mesh, tet, explode.value).centre, 2.8 * size, direction);
        tell(tet, centre, viewer.element.clientWidth / 2);
        aimAt(centre);
      });
    }),
    effect(() => {
      const place = marked.value;
      if (!place) return;
      const group = buildMarkers(place, shownResult('remesh'), dotRadius());
      viewer.add(group);
      canvas.invalidate();
      return () => {
        viewer.scene.remove(group);
        disposeMarkers(group);
        canvas.invalidate();
      };
    }),
  ];

  function dotRadius(): number {
    return viewer.bounds.getSize(new Vector3()).length() / 120;
  }

  /** Puts the crosshair at a place in mm. */
  function aimAt(point: Vector3): void {
    const known = volume.value;
    if (!known) return;
    const index = toIndex(known.index_to_mm, point.toArray());
    slicePlaces.value = index.map((x, axis) =>
      known.size[axis] < 2 ? 0.5 : Math.max(0, Math.min(1, Math.round(x) / (known.size[axis] - 1))),
    ) as Vec3;
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
      case 'picture':
        // Few pictures are taken: its code comes with the first one.
        order.take(
          import('./frame/picture').then(({ takePicture }) =>
            takePicture(canvas, container, bodyLegend.value ?? sliceLegend.value),
          ),
        );
        break;
      case 'tell_camera':
        order.take(viewer.cameraNow());
        break;
      case 'place_camera':
        viewer.placeCamera(order.camera);
        break;
      case 'cut_facing_me': {
        const towards = viewer.camera.position.clone().sub(viewer.controls.target).normalize();
        cut.value = { ...cut.value, on: true, normal: towards.toArray() };
        break;
      }
    }
  }

  function excite(place: Vec3): void {
    import('../store/case/physics').then(({ stimulateAt }) => stimulateAt(place), tellError);
  }

  /** Shows the numbers of an element that is seen so many pixels from the left of the 3-D view. */
  function tell(element: number, place: Vector3, x: number): void {
    const found = describe(stageShown.value, element, place.toArray());
    const middle = container.clientWidth / 2;
    const left = main.offsetLeft + x < middle;
    picked.value = found && { ...found, side: left ? 'left' : 'right' };
  }

  /** What is seen at a place of the 3-D view. */
  function hitAt(x: number, y: number): Hit | null {
    const { clientWidth: width, clientHeight: height } = viewer.element;
    const hit = pickAt(canvas.renderer, viewer.camera, body.pickable, { width, height }, { x, y });
    canvas.invalidate();
    return hit;
  }

  /** Shows the numbers of what is seen at a place, and puts the crosshair there. */
  function pick(x: number, y: number): void {
    const hit = hitAt(x, y);
    if (stimulating.value && mayStimulate.value) {
      if (hit) excite(hit.point.toArray());
      return;
    }
    batch(() => {
      if (!hit) picked.value = null;
      else {
        tell(body.owners ? body.owners[hit.element] : hit.element, hit.point, x);
        aimAt(hit.point);
      }
    });
  }

  let pressed: [number, number] | null = null;
  viewer.element.addEventListener('pointerdown', (event) => (pressed = [event.clientX, event.clientY]));
  viewer.element.addEventListener('pointerup', (event) => {
    const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4;
    pressed = null;
    const box = viewer.element.getBoundingClientRect();
    if (still) pick(event.clientX - box.left, event.clientY - box.top);
  });
  viewer.element.addEventListener('dblclick', (event) => {
    const box = viewer.element.getBoundingClientRect();
    const hit = hitAt(event.clientX - box.left, event.clientY - box.top);
    if (!hit || (stimulating.value && mayStimulate.value)) return;
    batch(() => {
      picked.value = null;
      addRegion('sphere', hit.point.toArray());
    });
  });
  viewer.element.addEventListener('keydown', (event) => {
    if (event.key === 'Enter' && !event.ctrlKey && !event.metaKey)
      pick(viewer.element.clientWidth / 2, viewer.element.clientHeight / 2);
  });

  if (untracked(() => recipe.value && pointsOf(stageShown.value))) viewer.fitFromFront();
  sceneMounted.value = true;
  return () => {
    sceneMounted.value = false;
    for (const stop of stops) stop();
    slices.dispose();
    forgetSurroundings();
    body.dispose();
    other.dispose();
    twin.dispose();
    warmUp.dispose();
    viewer.dispose();
    canvas.dispose();
    container.replaceChildren();
  };
}
