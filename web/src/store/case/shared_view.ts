/** What is looked at, as a link carries it: camera, cut, colour, element, time. */
import { effect, signal, untracked } from '@preact/signals';
import { stageNames, type SharedView, type StageName, type Vec3 } from '../../engine/contract';
import { stepCount } from './recipe';
import { frameTimes } from '../run/frames';
import { seek } from '../run/player';
import { pointsOf, shownKeys, shownResult } from '../run/results';
import { simulatedFields } from '../run/simulated_fields';
import { activity } from '../run/stages';
import * as view from '../view';

/** What a link wants to be seen, until there is something to see. */
export const awaitedView = signal<SharedView | null>(null);

/** Digits that nobody sees would make links longer. */
const rounded = (value: number, digits: number): number => Number(value.toFixed(digits));
const roundedAll = ([x, y, z]: Vec3, digits: number): Vec3 => [
  rounded(x, digits),
  rounded(y, digits),
  rounded(z, digits),
];

function cameraNow(): Promise<view.Camera | null> {
  if (!view.sceneMounted.value) return Promise.resolve(null);
  return new Promise((told) => (view.command.value = { kind: 'tell_camera', take: told }));
}

/** The view as it stands, without what it shows of itself. */
export async function viewNow(): Promise<Partial<SharedView>> {
  const camera = await cameraNow();
  const { on, flat, normal, place } = view.cut.value;
  const now: Partial<SharedView> = {};
  const stage = view.stageShown.value;
  if (stage !== 'quality') now.stage = stage;
  if (view.colourBy.value !== 'label') now.colour = view.colourBy.value;
  if (view.layout.value === 'slices') {
    now.layout = 'slices';
    now.crosshair = roundedAll(view.slicePlaces.value, 4);
  }
  if (camera)
    now.camera = {
      position_mm: roundedAll(camera.position_mm, 1),
      target_mm: roundedAll(camera.target_mm, 1),
    };
  if (on) now.cut = { normal: roundedAll(normal, 4), place: rounded(place, 4), flat };
  if (view.hiddenLabels.value.size > 0) now.hidden = [...view.hiddenLabels.value].sort((a, b) => a - b);
  if (view.focusTet.value !== null) now.element = view.focusTet.value;
  if (!view.showEdges.value) now.edges = false;
  if (view.explode.value > 0) now.explode = rounded(view.explode.value, 2);
  if (view.time.value > 0) now.time_ms = rounded(view.time.value, 3);
  return now;
}

/** What can be seen as soon as there is a body. */
function showBody({ camera, cut, layout, crosshair, hidden, edges, explode }: SharedView): void {
  view.chooseLayout(layout);
  if (layout === 'slices') view.slicePlaces.value = crosshair;
  view.hiddenLabels.value = new Set(hidden);
  view.showEdges.value = edges;
  view.explode.value = explode;
  if (cut && Math.hypot(...cut.normal) > 1e-6) {
    const length = Math.hypot(...cut.normal);
    view.cut.value = { ...cut, on: true, normal: cut.normal.map((x) => x / length) as Vec3 };
  }
  if (camera) view.command.value = { kind: 'place_camera', camera };
}

/** What is a stage's, once that has run. */
function showStage(wanted: SharedView, stage: StageName): void {
  view.stageShown.value = stage;
  view.colourBy.value = wanted.colour || 'label';
  // After an edit the number is another element's.
  if (wanted.element < 0 || stepCount.value > 0) return;
  view.focusTet.value = wanted.element;
  // The element has brought the camera to itself: the link's own place counts.
  if (wanted.camera) view.command.value = { kind: 'place_camera', camera: wanted.camera };
}

/** Shows what a link wants to be seen, part by part as it comes to be there. */
export function keepSharedView(): void {
  let parts = new Set<'body' | 'stage' | 'time'>();
  effect(() => {
    void awaitedView.value;
    parts = new Set();
  });
  const once = (part: 'body' | 'stage' | 'time', show: () => void) => {
    if (parts.has(part)) return;
    parts.add(part);
    untracked(show);
  };
  effect(() => {
    const wanted = awaitedView.value;
    if (!wanted) return;
    const stage = stageNames.find((name) => name === wanted.stage) ?? 'quality';
    const atRest = activity.value === 'idle';
    const body = pointsOf('surface') ?? pointsOf('optimise');
    const there = shownKeys.value[stage] !== undefined;
    const simulated = simulatedFields.value.some(({ info }) => info.name === wanted.colour);
    const last = frameTimes.value.at(-1) ?? 0;
    if (!atRest || !body) return;
    once('body', () => showBody(wanted));
    if (!there || (stage === 'quality' && !shownResult('optimise'))) return;
    once('stage', () => showStage(wanted, stage));
    if (last > 0 && last >= wanted.time_ms)
      once('time', () => {
        if (simulated) view.colourBy.value = wanted.colour;
        seek(wanted.time_ms);
      });
  });
}
