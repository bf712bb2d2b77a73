import { effect, untracked } from '@preact/signals';
import { Group } from 'three';
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
import { fibresShown } from '../../store/run/fibres';
import { shownResult } from '../../store/run/results';
import { explode, fibreLegend, fibreStyle, hiddenLabels, seeThrough, type Legend } from '../../store/view';
import type { Canvas } from '../frame/canvas';
import { nextTask } from '../frame/tasks';
import { fibreDrawing, type FibreDrawing } from './fibre_drawing';
import { noClip } from './element_material';
import type { Plane } from './tet_model';

/** How many glyphs there are at once, about; and cubes of which each has one line. */
const glyphCount = 3000;
const lineCells = 5000;

const legend: Legend = { title: 'Helix angle', unit: '°', lo: -90, hi: 90, map: 'vik' };

/** How long the page may wait for lines to be traced, in one task. */
const patienceMs = 8;

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

/** Lines, traced a few a task; null where they are no longer wanted. */
async function linesOf(field: FibreField, spacing: number, wanted: () => boolean): Promise<Pieces | null> {
  const lines = tracedLines(field, { spacing, longest: 40 * spacing });
  let begin = performance.now();
  for (;;) {
    const { done, value } = lines.next();
    if (done) return value;
    if (performance.now() - begin < patienceMs) continue;
    await nextTask();
    if (!wanted()) return null;
    begin = performance.now();
  }
}

/** Draws the fibres of the mesh that is shown, in the group of its body. */
export function addFibres(
  canvas: Canvas,
  body: Group,
  plane: () => Plane | null,
  shows: () => boolean,
): () => void {
  const group = new Group();
  body.add(group);
  let drawing: FibreDrawing | null = null;
  let cell = 1;
  let count = 0;
  const clear = () => {
    drawing?.geometry.dispose();
    drawing?.material.dispose();
    drawing = null;
    group.clear();
    fibreLegend.value = null;
    canvas.invalidate();
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
    canvas.invalidate();
  };
  const show = async (mesh: TetArrays, { fibre, helix }: FibreArrays, lines: boolean) => {
    const mine = ++count;
    const hidden = hiddenLabels.value;
    const field: FibreField = { mesh, fibre, shows: (tet) => !hidden.has(mesh.labels[tet]) };
    const size = cellSize(field, lines ? lineCells : glyphCount);
    await nextTask();
    const pieces = lines
      ? await linesOf(field, size, () => mine === count)
      : glyphPieces(field, evenlySpread(field, size), 0.85 * size);
    if (!pieces || mine !== count) return;
    clear();
    cell = size;
    const radius = (lines ? 0.12 : 0.09) * size;
    drawing = fibreDrawing(pieces, helixColours(helix, pieces.tets), waysOf(mesh, pieces.tets), radius);
    group.add(drawing);
    fibreLegend.value = legend;
    untracked(look);
  };
  const stops = [
    effect(() => {
      const mesh = shows() ? shownResult('optimise') : undefined;
      const fibres = fibresShown.value;
      const lines = fibreStyle.value === 'lines';
      void hiddenLabels.value;
      if (mesh && fibres && 3 * mesh.labels.length === fibres.fibre.length)
        untracked(() => void show(mesh, fibres, lines));
      else {
        count++;
        untracked(clear);
      }
    }),
    effect(look),
  ];
  return () => {
    for (const stop of stops) stop();
    count++;
    clear();
    body.remove(group);
  };
}
