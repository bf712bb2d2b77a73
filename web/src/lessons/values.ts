/**
 * Values of the app that a lesson may name. This list is all there is: a name is looked up in it, and nothing that a
 * lesson says is run or followed into an object. A value is null where the app has none now; those of a run, where the
 * mesh that is shown is not what the recipe asks for.
 */
import { stageNames, type Metric, type Recipe, type Report } from '../engine/contract';
import { canonicalJson } from '../link/canonical';
import { meshedLabels } from '../store/case/labels';
import { volume } from '../store/case/input';
import { recipe } from '../store/case/recipe';
import { pinned, pinnedArrays, pinnedFound } from '../store/run/compare';
import { foundFields, foundPhysics, foundValues, hasValue, simulated } from '../store/run/frames';
import { meshedRecipe, report, upToDate } from '../store/run/report';
import { shownResult } from '../store/run/results';
import { isMadeFrom, stages } from '../store/run/stages';
import { colourBy, cut, layout, sliceOverlay, stageShown } from '../store/view';
import type { ValueRef } from './lesson';
import { enclosedMm3, surfaceMm2, type Triangles } from './shapes';
import { excitation, heartbeat, percentOf, type SimulatedRow } from './simulated_values';
import { spectrumOf } from './stiffness';

/** A finished run: the one that is shown, or the pinned one. */
interface Run {
  report: Report;
  recipe: Recipe;
  mesh: NonNullable<ReturnType<typeof pinnedArrays>>['mesh'];
  simulated: typeof simulated.value;
  found(name: string): Float32Array | undefined;
}

export type Found = number | string | null;

export interface Value {
  name: string;
  title: string;
  unit: string;
  group: string;
  ofLabel: boolean;
  /** A pinned run has it too. */
  ofRun: boolean;
  read(label: number, run: 'shown' | 'pinned'): Found;
}

function shownRun(): Run | null {
  const mesh = shownResult('optimise');
  if (!report.value || !meshedRecipe.value || !mesh || !upToDate.value) return null;
  // What was simulated with other tissue or stimuli says nothing of those that are asked for now.
  const same = canonicalJson(foundPhysics.value) === canonicalJson(recipe.value?.physics ?? null);
  void foundFields.value;
  return {
    report: report.value,
    recipe: meshedRecipe.value,
    mesh,
    simulated: same ? simulated.value : {},
    found: (name) => (same ? foundValues(name) : undefined),
  };
}

function pinnedRun(): Run | null {
  const run = pinned.value;
  const arrays = pinnedArrays();
  return run && arrays && { ...run, mesh: arrays.mesh, found: pinnedFound };
}

const values: Value[] = [];

type Row = readonly [string, string, string, (label: number) => Found];

function add(group: string, rows: readonly Row[], ofLabel = false): void {
  for (const [name, title, unit, read] of rows)
    values.push({ name, title, unit, group, ofLabel, ofRun: false, read });
}

type RunRow = readonly [string, string, string, (run: Run, label: number) => number | undefined | null];

function addOfRun(group: string, rows: readonly RunRow[], ofLabel = false): void {
  for (const [name, title, unit, of] of rows) {
    const read: Value['read'] = (label, which) => {
      const run = which === 'shown' ? shownRun() : pinnedRun();
      return (run && of(run, label)) ?? null;
    };
    values.push({ name, title, unit, group, ofLabel, ofRun: true, read });
  }
}

const flag = (holds: boolean | undefined): number => (holds ? 1 : 0);
const asked = <T>(of: (current: Recipe) => T): T | null => (recipe.value ? of(recipe.value) : null);

add('Case', [
  ['case.edge_mm', 'Edge length', 'mm', () => asked(({ sizing }) => sizing.edge_mm)],
  ['case.gradation', 'Growth per mm', '', () => asked(({ sizing }) => sizing.gradation)],
  [
    'case.regions',
    'Regions with their own edge length',
    '',
    () => asked(({ sizing }) => sizing.regions.length),
  ],
  [
    'case.region_edge_mm',
    'Smallest edge length of a region',
    'mm',
    () =>
      asked(({ sizing: { regions } }) =>
        regions.length ? Math.min(...regions.map((one) => one.edge_mm)) : null,
      ),
  ],
  [
    'case.layers',
    'Elements asked for across a wall',
    '',
    () => asked(({ sizing }) => Math.max(0, ...sizing.thickness.map(({ layers }) => layers))),
  ],
  [
    'case.exact_layers',
    'Exactly so many layers (1: yes)',
    '',
    () => asked(({ sizing }) => flag(sizing.thickness.some(({ layering }) => layering === 'exact'))),
  ],
  ['case.labels', 'Labels that are meshed', '', () => (volume.value ? meshedLabels.value.size : null)],
  ['case.merged', 'Groups of labels meshed as one', '', () => asked(({ merge }) => merge.length)],
  ['case.smooth_iterations', 'Smoothing, iterations', '', () => asked(({ smooth }) => smooth.iterations)],
  [
    'case.keep_volume',
    'Volumes restored (1: yes)',
    '',
    () => asked(({ smooth }) => flag(smooth.keep_volume)),
  ],
  ['case.optimise_rounds', 'Rounds of optimisation', '', () => asked(({ optimise }) => optimise.rounds)],
  ['case.remesh_method', 'Method of remeshing', '', () => asked(({ remesh }) => remesh.method)],
  [
    'case.isthmus_mm',
    'Width of the isthmus',
    'mm',
    () => asked(({ source }) => source.phantom?.isthmus_mm ?? null),
  ],
  [
    'case.voxel_mm',
    'Longest voxel spacing',
    'mm',
    () => (volume.value ? Math.max(...volume.value.spacing_mm) : null),
  ],
  [
    'case.beat_element',
    'Elements of the heartbeat',
    '',
    () => asked(({ physics }) => physics?.mechanics?.element ?? null),
  ],
  ['case.stimuli', 'Stimuli', '', () => asked(({ physics }) => physics?.stimuli.length ?? 0)],
]);
add(
  'Case',
  [
    [
      'case.label_edge_mm',
      'Edge length inside a label',
      'mm',
      (label) =>
        asked(({ sizing }) => sizing.labels.find((one) => one.label === label)?.edge_mm ?? sizing.edge_mm),
    ],
    [
      'case.speed_mm_per_ms',
      'Speed of the wave in a label (0: none)',
      'm/s',
      (label) =>
        asked(
          ({ physics }) =>
            physics?.tissue.kinds.find(({ labels }) => labels.includes(label))?.along_mm_per_ms ?? 0,
        ),
    ],
  ],
  true,
);

add('Stages', [
  ...stageNames.map(
    (name): Row => [
      `stage.${name}.done`,
      `Stage ${name} is up to date (1: yes)`,
      '',
      () => asked((current) => flag(isMadeFrom(current, name))),
    ],
  ),
  ['run.done', 'The mesh is what the case asks for (1: yes)', '', () => flag(shownRun() !== null)],
  ['run.pinned', 'A run is pinned (1: yes)', '', () => flag(pinned.value !== null)],
  [
    'wave.done',
    'The activation map is up to date (1: yes)',
    '',
    () => flag(shownRun()?.simulated.eikonal !== undefined),
  ],
  [
    'wave.played',
    'The wave has been simulated (1: yes)',
    '',
    () => flag(shownRun()?.simulated.monodomain !== undefined),
  ],
  [
    'beat.done',
    'The heart has beaten (1: yes)',
    '',
    () => flag(shownRun()?.simulated.mechanics !== undefined),
  ],
]);

add('View', [
  ['view.stage', 'Stage that is shown', '', () => stageShown.value],
  ['view.layout', 'Layout', '', () => layout.value],
  ['view.colour', 'What the mesh is coloured by', '', () => colourBy.value],
  ['view.slices', 'What the slices show', '', () => sliceOverlay.value],
  ['view.cut', 'The body is cut open (1: yes)', '', () => flag(cut.value.on)],
]);

const counted = (name: 'sizing', key: string): Found => {
  const current = recipe.value;
  if (!current || !isMadeFrom(current, name)) return null;
  const count = stages.value[name].summary?.counts[key];
  return typeof count === 'number' ? count : null;
};

/** A surface that is up to date. */
function surface(stage: 'surface' | 'smooth', of: (found: Triangles) => number): Found {
  const found = shownResult(stage);
  const current = recipe.value;
  return found && current && isMadeFrom(current, stage) ? of(found) : null;
}

add('Surface and sizes', [
  [
    'surface.triangles',
    'Triangles of the label surface',
    '',
    () => surface('surface', (s) => s.triangles.length / 3),
  ],
  ['surface.area_mm2', 'Area with the staircase', 'mm²', () => surface('surface', surfaceMm2)],
  ['smooth.area_mm2', 'Area of the smooth surface', 'mm²', () => surface('smooth', surfaceMm2)],
  ['surface.volume_mm3', 'Volume within the staircase', 'mm³', () => surface('surface', enclosedMm3)],
  ['smooth.volume_mm3', 'Volume within the smooth surface', 'mm³', () => surface('smooth', enclosedMm3)],
  ['sizing.min_mm', 'Smallest target edge length', 'mm', () => counted('sizing', 'min_mm')],
  ['sizing.max_mm', 'Largest target edge length', 'mm', () => counted('sizing', 'max_mm')],
]);

addOfRun('Mesh', [
  ['mesh.tets', 'Tetrahedra', '', ({ report }) => report.tets],
  ['mesh.points', 'Points', '', ({ report }) => report.points],
  ['mesh.labels', 'Labels of the mesh', '', ({ mesh }) => new Set(mesh.labels).size],
  ['mesh.passed', 'All hard checks hold (1: yes)', '', ({ report }) => flag(report.quality.passed)],
  [
    'mesh.interfaces',
    'Pairs of labels that touch',
    '',
    ({ report }) => report.fidelity?.topology.contacts.after.filter(([low]) => low > 0).length,
  ],
]);

/** Measures and figures of them, by names of ours. */
const measures: readonly [string, string, string][] = [
  ['min_dihedral_deg', 'Smallest dihedral angle', '°'],
  ['max_dihedral_deg', 'Largest dihedral angle', '°'],
  ['aspect_ratio', 'Aspect ratio', ''],
  ['radius_ratio', 'Radius ratio', ''],
  ['mean_ratio', 'Mean ratio', ''],
  ['edge_mm', 'Mean edge length', 'mm'],
];
const figures: readonly ['min' | 'p1' | 'median' | 'p99' | 'max', string][] = [
  ['min', 'least'],
  ['p1', '1st percentile'],
  ['median', 'median'],
  ['p99', '99th percentile'],
  ['max', 'most'],
];
const metric = (run: Run, name: string): Metric | undefined =>
  run.report.quality.metrics.find((one) => one.name === name);
for (const [name, title, unit] of measures)
  addOfRun(
    'Shape of the tetrahedra',
    figures.map(([figure, word]) => [
      `quality.${name}.${figure}`,
      `${title}, ${word}`,
      unit,
      (run) => metric(run, name)?.[figure],
    ]),
  );
addOfRun('Shape of the tetrahedra', [
  [
    'stiffness.largest',
    'Largest eigenvalue of the stiffness matrix',
    'mm',
    ({ mesh }) => spectrumOf(mesh)?.largest,
  ],
  ['stiffness.smallest', 'Smallest eigenvalue above 0', 'mm', ({ mesh }) => spectrumOf(mesh)?.smallest],
  [
    'stiffness.condition',
    'Condition number of the stiffness matrix',
    '',
    ({ mesh }) => spectrumOf(mesh)?.condition,
  ],
]);

const fidelity = ({ report }: Run) => report.fidelity;
addOfRun('Fidelity', [
  [
    'fidelity.dice_min',
    'Least Dice overlap of a label',
    '',
    (run) => least(fidelity(run)?.labels.map(({ dice }) => dice)),
  ],
  [
    'fidelity.volume_error_percent',
    'Largest error of a volume',
    '%',
    (run) => most(fidelity(run)?.labels.map((one) => Math.abs(one.volume_error_percent))),
  ],
  [
    'fidelity.distance_mean_mm',
    'Mean distance to the labels',
    'mm',
    (run) => fidelity(run)?.mesh_to_surface.mean_mm,
  ],
  [
    'fidelity.distance_max_mm',
    'Largest distance to the labels',
    'mm',
    (run) => fidelity(run)?.mesh_to_surface.max_mm,
  ],
  ['topology.differences', 'Changes of topology', '', (run) => fidelity(run)?.topology.differences.length],
]);

const least = (numbers: number[] | undefined) => (numbers?.length ? Math.min(...numbers) : undefined);
const most = (numbers: number[] | undefined) => (numbers?.length ? Math.max(...numbers) : undefined);
const sizesOf = (run: Run, label: number) => fidelity(run)?.labels.find((one) => one.label === label);
const shapeOf = (run: Run, label: number) =>
  fidelity(run)?.topology.labels.find((one) => one.label === label);

/** When the wave has come to the last point of a label, by the activation map. */
function lastActivation({ mesh, found, simulated }: Run, label: number): number | undefined {
  // An activation map of other physics stays to be looked at.
  const times = simulated.eikonal && found('eikonal_ms');
  if (!times) return undefined;
  let last: number | undefined;
  for (let i = 0; i < mesh.tets.length; i++) {
    const time = times[mesh.tets[i]];
    if (mesh.labels[i >> 2] === label && hasValue(time) && !(time <= last!)) last = time;
  }
  return last;
}

addOfRun(
  'One label',
  [
    ['label.tets', 'Tetrahedra', '', (run, label) => sizesOf(run, label)?.tets],
    ['label.volume_mm3', 'Volume in the mesh', 'mm³', (run, label) => sizesOf(run, label)?.mesh_mm3],
    ['label.dice', 'Dice overlap', '', (run, label) => sizesOf(run, label)?.dice],
    ['label.edge_mm', 'Median edge length', 'mm', (run, label) => sizesOf(run, label)?.median_edge_mm],
    ['label.components', 'Components', '', (run, label) => shapeOf(run, label)?.components[1]],
    ['label.cavities', 'Cavities', '', (run, label) => shapeOf(run, label)?.cavities[1]],
    ['label.handles', 'Handles', '', (run, label) => shapeOf(run, label)?.handles[1]],
    ['label.euler', 'Euler characteristic of its surface', '', (run, label) => shapeOf(run, label)?.euler[1]],
    ['label.last_ms', 'Last activation', 'ms', lastActivation],
  ],
  true,
);

addOfRun('Layers of a wall', [
  ['layers.target', 'Layers asked for', '', ({ report }) => report.layers?.[0]?.target_layers],
  [
    'layers.exact_percent',
    'Area with exactly so many',
    '%',
    ({ report }) => percentOf(report.layers?.[0]?.by_edges.exact),
  ],
  [
    'layers.enough_percent',
    'Area with no fewer',
    '%',
    ({ report }) => percentOf(report.layers?.[0]?.by_edges.at_least),
  ],
]);

const ofSimulated = (rows: readonly SimulatedRow[]): RunRow[] =>
  rows.map(([name, title, unit, of]) => [name, title, unit, (run) => of(run.simulated)]);
addOfRun('Excitation', ofSimulated(excitation));
addOfRun('Heartbeat', ofSimulated(heartbeat));

const byName = new Map(values.map((value) => [value.name, value]));

export const allValues: readonly Value[] = values;
export const valueNamed = (name: string): Value | undefined => byName.get(name);

/** What a value is now; over that of the pinned run where that is asked. */
export function readValue({ value, label = 0, per }: ValueRef): Found {
  const known = valueNamed(value);
  if (!known) return null;
  const now = known.read(label, 'shown');
  if (!per) return now;
  const before = known.read(label, 'pinned');
  return typeof now === 'number' && typeof before === 'number' && before !== 0 ? now / before : null;
}
