import { effect, signal, untracked } from '@preact/signals';
import { Group, Sphere, Vector3 } from 'three';
import { noValue, type FibreArrays, type TetArrays } from '../../engine/contract';
import { colourTable } from '../../geometry/colours';
import {
  cellSize,
  evenlySpread,
  glyphPieces,
  tracedLines,
  type FibreField,
  type Pieces,
} from '../../geometry/fibres';
import { movesShown } from '../../store/run/beat/motion';
import { fibresShown } from '../../store/run/fibres';
import { shownResult } from '../../store/run/results';
import { explode, fibreLegend, fibreStyle, hiddenLabels, seeThrough, type Legend } from '../../store/view';
import type { Viewer } from '../frame/viewer';
import { nextTask } from '../frame/tasks';
import { endWeights, movedEnds } from './moved_pieces';
import { fibreDrawing, setEnds, type FibreDrawing } from './fibre_drawing';
import { noClip } from '../frame/surroundings';
import type { Plane } from './tet_model';

/** How many glyphs there are at once, about; and cubes of which each has one line. */
const glyphCount = 3000;
const lineCells = 5000;

const legend: Legend = { title: 'Helix angle', unit: '°', lo: -90, hi: 90, map: 'vik' };

/** How long the page may wait for pieces to be found, in one task. */
const patienceMs = 8;

/** Three bytes for each piece: red goes from left to right, green from front to back, blue from foot to head. */
function wayColours(fibre: Float32Array, tets: Uint32Array): Uint8Array {
  const colours = new Uint8Array(3 * tets.length);
  tets.forEach((tet, i) => {
    for (let d = 0; d < 3; d++) colours[3 * i + d] = 255 * Math.abs(fibre[3 * tet + d]);
  });
  return colours;
}

/** Three bytes for each piece. */
function helixColours(helix: Float32Array, tets: Uint32Array): Uint8Array {
  const table = colourTable(legend.map);
  const colours = new Uint8Array(3 * tets.length);
  tets.forEach((tet, i) => {
    const value = helix[tet];
    const at = Math.round((255 * (value - legend.lo)) / (legend.hi - legend.lo));
    colours.set(value <= noValue ? [150, 150, 150] : table.subarray(3 * at, 3 * at + 3), 3 * i);
  });
  return colours;
}

/** The way in which each piece goes when labels are pulled apart. */
function waysOf(mesh: TetArrays, tets: Uint32Array): Float32Array {
  const ways = new Map<number, Float32Array>();
  for (let i = 0; i < mesh.ways.length; i += 4) ways.set(mesh.ways[i], mesh.ways.subarray(i + 1, i + 4));
  const all = new Float32Array(3 * tets.length);
  tets.forEach((tet, i) => all.set(ways.get(mesh.labels[tet]) ?? [0, 0, 0], 3 * i));
  return all;
}

/** Works in tasks that leave the page free to answer; null where the result is no longer wanted. */
async function inSlices<T>(work: Generator<void, T, void>, wanted: () => boolean): Promise<T | null> {
  let begin = performance.now();
  for (;;) {
    const { done, value } = work.next();
    if (done) return value;
    if (performance.now() - begin < patienceMs) continue;
    await nextTask();
    if (!wanted()) return null;
    begin = performance.now();
  }
}

function* pieced(field: FibreField, lines: boolean): Generator<void, { size: number; pieces: Pieces }, void> {
  const size = yield* cellSize(field, lines ? lineCells : glyphCount);
  const pieces = lines
    ? yield* tracedLines(field, { spacing: size, longest: 40 * size })
    : glyphPieces(field, yield* evenlySpread(field, size), 0.85 * size);
  return { size, pieces };
}

/** Where the camera looks and how far around that it sees; null where it sees most of the body. */
function sightOf({ camera, controls, bounds }: Viewer): Sphere | null {
  const half = (camera.fov * Math.PI) / 360;
  const radius =
    1.3 * Math.tan(half) * Math.max(1, camera.aspect) * camera.position.distanceTo(controls.target);
  if (radius > 0.75 * bounds.getBoundingSphere(new Sphere()).radius) return null;
  return new Sphere(controls.target.clone(), radius);
}

/** Whether what was chosen for one sight does for another. */
function doesFor(chosen: Sphere | null, now: Sphere | null): boolean {
  if (!chosen || !now) return chosen === now;
  const scale = now.radius / chosen.radius;
  return scale > 0.7 && scale < 1.1 && chosen.center.distanceTo(now.center) < 0.3 * chosen.radius;
}

/** From the last turn of the camera until fibres are chosen anew. */
const restMs = 250;

/** Draws the fibres of the mesh that is shown, in the group of its body: as many as ever of what is in sight. */
export function addFibres(
  viewer: Viewer,
  body: Group,
  plane: () => Plane | null,
  shows: () => boolean,
): () => void {
  const sight = signal<Sphere | null>(null);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const stopWatching = viewer.onDraw(() => {
    if (!drawing || doesFor(sight.peek(), sightOf(viewer))) return;
    clearTimeout(timer);
    timer = setTimeout(() => (sight.value = sightOf(viewer)), restMs);
  });
  const group = new Group();
  body.add(group);
  let drawing: FibreDrawing | null = null;
  let cell = 1;
  let count = 0;
  /** Where the pieces that are drawn are at rest, and what their ends are made of. */
  let drawn: { mesh: TetArrays; pieces: Pieces; weights: Float32Array } | null = null;
  const clear = () => {
    drawing?.geometry.dispose();
    drawing?.material.dispose();
    drawing = drawn = null;
    group.clear();
    fibreLegend.value = null;
    viewer.invalidate();
  };
  const move = () => {
    const moves = movesShown.value;
    if (!drawing || !drawn) return;
    const { mesh, pieces, weights } = drawn;
    const fits = moves?.length === mesh.points.length;
    setEnds(drawing, fits ? movedEnds(mesh.tets, pieces, weights, moves) : pieces.ends);
    viewer.invalidate();
  };
  const look = () => {
    const at = plane();
    const [apart, behind] = [explode.value, seeThrough.value];
    if (!drawing) return;
    const { uniforms } = drawing.material;
    if (at) uniforms.cutPlane.value.set(...at.normal, at.offset);
    else uniforms.cutPlane.value.copy(noClip);
    uniforms.explode.value = apart;
    uniforms.nearer.value = behind ? 0 : cell;
    viewer.invalidate();
  };
  const show = async (mesh: TetArrays, { fibre, helix }: FibreArrays, lines: boolean) => {
    const mine = ++count;
    const [hidden, seen] = [hiddenLabels.value, sight.value];
    const place = new Vector3();
    const isSeen = (tet: number) => !seen || seen.containsPoint(place.fromArray(mesh.centres, 4 * tet));
    const field = { mesh, fibre, shows: (tet: number) => !hidden.has(mesh.labels[tet]) && isSeen(tet) };
    const found = await inSlices(pieced(field, lines), () => mine === count);
    if (!found || mine !== count) return;
    const { size, pieces } = found;
    clear();
    cell = size;
    const radius = (lines ? 0.12 : 0.09) * size;
    const colours = helix ? helixColours(helix, pieces.tets) : wayColours(fibre, pieces.tets);
    drawing = fibreDrawing(pieces, colours, waysOf(mesh, pieces.tets), radius);
    group.add(drawing);
    drawn = { mesh, pieces, weights: endWeights(mesh, pieces) };
    untracked(move);
    fibreLegend.value = helix && legend;
    untracked(look);
  };
  const stops = [
    effect(() => {
      const mesh = shows() ? shownResult('optimise') : undefined;
      const fibres = fibresShown.value;
      const lines = fibreStyle.value === 'lines';
      void hiddenLabels.value;
      void sight.value;
      if (mesh && fibres && 3 * mesh.labels.length === fibres.fibre.length)
        untracked(() => void show(mesh, fibres, lines));
      else {
        count++;
        untracked(clear);
      }
    }),
    effect(look),
    effect(move),
  ];
  return () => {
    for (const stop of stops) stop();
    clearTimeout(timer);
    stopWatching();
    count++;
    clear();
    body.remove(group);
  };
}
