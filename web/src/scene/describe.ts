/** The numbers of one element, in words: no three.js. */
import { noValue, type StageArrays, type StageName, type TetArrays } from '../engine/contract';
import { coordinate } from '../geometry/orientation';
import { voxelMm } from '../store/case/input';
import { hasValue } from '../store/run/frames';
import { simulatedFields, simulatedValues } from '../store/run/simulated_fields';
import { shownResult } from '../store/run/results';
import { fractionLabel, type Picked } from '../store/view';
import { nameOf } from '../store/case/legend/legend';

/** What was transferred from the image to one tet. */
function lookedUpLines({ values: arrays }: StageArrays['quality'], tet: number): [string, string][] {
  const { centroid_label: centroid, majority_label: majority } = arrays;
  if (!centroid || !majority) return [];
  const shares = Object.entries(arrays).flatMap(([name, values]): [string, string][] => {
    const label = fractionLabel(name);
    return label === null ? [] : [[`Share of ${nameOf(label)}`, `${(100 * values[tet]).toFixed(0)} %`]];
  });
  return [['At its centroid', nameOf(centroid[tet])], ['Most of it', nameOf(majority[tet])], ...shares];
}

/** Fields that other lines tell. */
const toldApart = /^(edge_mm|target_mm|size_log2|(min|max)_dihedral_deg)$/;

function measureLines(measures: StageArrays['quality'], tet: number): [string, string][] {
  const { fields, values } = measures;
  const ratio = 2 ** values.size_log2[tet];
  return [
    [
      'Dihedral angles',
      `${values.min_dihedral_deg[tet].toFixed(1)}° to ${values.max_dihedral_deg[tet].toFixed(1)}°`,
    ],
    ['Mean edge', `${values.edge_mm[tet].toFixed(2)} mm`],
    ['Target edge', `${values.target_mm[tet].toFixed(2)} mm (× ${ratio.toFixed(2)})`],
    ...fields
      .filter(({ name, on, scale }) => on === 'tets' && scale === 'sequential' && !toldApart.test(name))
      .filter(({ name }) => fractionLabel(name) === null)
      .map(({ name, title }): [string, string] => [title, values[name][tet].toFixed(3)]),
    ...layerLines(measures, tet),
    ...lookedUpLines(measures, tet),
  ];
}

function layerLines({ values }: StageArrays['quality'], tet: number): [string, string][] {
  const { layer, layers_across: across } = values;
  if (!layer || layer[tet] < 0) return [];
  const of = across && across[tet] >= 0 ? `, ${across[tet]} across the wall` : '';
  return [['Layer', `${layer[tet]} from the inner surface${of}`]];
}

/** Of the corners that lie on a label's boundary the one farthest from the label surface. */
function distanceLines(
  { values }: StageArrays['quality'],
  { tets }: TetArrays,
  tet: number,
): [string, string][] {
  const { distance_mm: distances } = values;
  if (!distances) return [];
  const largest = Math.max(...[0, 1, 2, 3].map((corner) => distances[tets[4 * tet + corner]]));
  if (largest < 0) return [];
  return [['To the labels', `${largest.toFixed(3)} mm (${(largest / voxelMm.value).toFixed(2)} voxels)`]];
}

/** "4 % slow here". */
export function speedErrorText(percent: number): string {
  const size = Math.abs(percent);
  if (size < 0.05) return 'right here';
  return `${size < 1 ? size.toFixed(1) : size.toFixed(0)} % ${percent < 0 ? 'slow' : 'fast'} here`;
}

/** What simulations say of one tet: of points, the mean of its corners. */
function simulatedLines({ tets }: TetArrays, tet: number): [string, string][] {
  return simulatedFields.value.flatMap(({ info }): [string, string][] => {
    // There is no mean around a circle.
    if (info.scale === 'cyclic') return [];
    const values = simulatedValues(info.name);
    const places = info.on === 'points' ? [0, 1, 2, 3].map((corner) => tets[4 * tet + corner]) : [tet];
    const known = places.map((place) => values?.[place] ?? noValue);
    if (!known.every(hasValue)) return [];
    const mean = known.reduce((sum, value) => sum + value, 0) / known.length;
    if (info.name === 'speed_error_percent') return [['Wave expected', speedErrorText(mean)]];
    const unit = info.unit === '1' ? '' : ` ${info.unit}`;
    return [[info.title, `${info.scale === 'whole' ? mean.toFixed(0) : mean.toPrecision(4)}${unit}`]];
  });
}

/** All of what is shown of an element but where in the view it is. */
export function describe(
  stage: StageName,
  element: number,
  point?: readonly number[],
): Omit<Picked, 'side'> | null {
  const at: [string, string][] = point ? [['At', `${point.map(coordinate).join(', ')} mm`]] : [];
  if (stage === 'optimise' || stage === 'quality') {
    const mesh = shownResult('optimise');
    const measures = shownResult('quality');
    if (!mesh) return null;
    return {
      stage,
      element,
      title: `Tetrahedron ${element.toLocaleString('en')}`,
      lines: [
        ['Label', nameOf(mesh.labels[element])],
        ...(measures ? measureLines(measures, element) : []),
        ...(measures ? distanceLines(measures, mesh, element) : []),
        ...simulatedLines(mesh, element),
        ...at,
      ],
    };
  }
  if (stage !== 'surface' && stage !== 'smooth' && stage !== 'remesh') return null;
  const mesh = shownResult(stage);
  if (!mesh) return null;
  const [behind, front] = [mesh.sides[2 * element], mesh.sides[2 * element + 1]];
  return {
    stage,
    element,
    title: `Triangle ${element.toLocaleString('en')}`,
    lines: [['Between', `${nameOf(behind)} and ${nameOf(front)}`], ...at],
  };
}
