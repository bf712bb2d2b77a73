/** What a simulation of the heart begins with, until the user says otherwise. */
import type {
  BeatParams,
  MonodomainParams,
  Physics,
  Recipe,
  Stimulus,
  TissueKind,
  Vec3,
} from '../../engine/contract';
import { announcement } from '../notices';
import { engine, tellError } from '../run/engine';
import { simulatedPhysics } from '../run/frames';
import { shownResult } from '../run/results';
import { groupDefaults, itemDefaults } from '../run/schema_defaults';
import { fibresAreGiven, volume } from './input';
import { caseId, editRecipe, recipe } from './recipe';
import { acrossShare, tissuePresets } from './tissue_presets';
import { nameOf } from './legend/legend';

/** Names of labels that do not conduct, and of those that conduct slowly. */
const noTissue = /pool|blood|scar|core|cavity|lumen|fat|fibrosis|valve/i;
const slow = /border|gr[ae]y/i;

/** Labels that are meshed. */
export function meshedLabels(current: Recipe): number[] {
  const known = volume.value?.labels.map(({ label }) => label) ?? [];
  return current.labels.length > 0 ? [...current.labels] : known;
}

export const newTissue = (labels: number[]): TissueKind => ({
  ...itemDefaults<TissueKind>('physics.tissue.kinds'),
  labels,
});

/** The lowest point of the mesh, which is the apex of most hearts; without a mesh the middle of the volume. */
function lowestPoint(): { at: Vec3; radius: number } {
  const points = shownResult('optimise')?.points;
  if (!points) return { at: [0, 0, 0], radius: 10 };
  let lowest = 0;
  let highest = 0;
  for (let i = 0; i < points.length; i += 3) {
    if (points[i + 2] < points[lowest + 2]) lowest = i;
    if (points[i + 2] > points[highest + 2]) highest = i;
  }
  const round = (x: number) => Math.round(10 * x) / 10;
  const at = [points[lowest], points[lowest + 1], points[lowest + 2]].map(round) as Vec3;
  return { at, radius: Math.max(1, Math.round((points[highest + 2] - points[lowest + 2]) / 10)) };
}

export function newStimulus(count: number): Stimulus {
  const { at, radius } = lowestPoint();
  return {
    ...itemDefaults<Stimulus>('physics.stimuli'),
    name: `Stimulus ${count + 1}`,
    centre_mm: at,
    radius_mm: radius,
  };
}

/** A click excites a ball of this radius, or half as much again as an edge of the mesh, mm. */
const clickRadius = 5;

/** Excites the tissue at a place of the wave under way. The case has the stimulus from then on, at its time. */
export async function stimulateAt(centre_mm: Vec3): Promise<void> {
  const [current, id] = [recipe.value, caseId.value];
  if (!current?.physics) return;
  const stimulus: Stimulus = {
    ...itemDefaults<Stimulus>('physics.stimuli'),
    name: `Stimulus ${current.physics.stimuli.length + 1}`,
    centre_mm: centre_mm.map((x) => Math.round(10 * x) / 10) as Vec3,
    radius_mm: Math.max(clickRadius, 1.5 * current.sizing.edge_mm),
    start_ms: 0,
  };
  try {
    const given = await engine.stimulate(stimulus);
    if (caseId.value !== id) return;
    const asked = simulatedPhysics.value;
    if (asked) simulatedPhysics.value = { ...asked, stimuli: [...asked.stimuli, given] };
    editRecipe('Stimulate here', ({ physics }) => void physics?.stimuli.push(given));
    announcement.value = `${given.name} is given at ${given.start_ms.toFixed(1)} ms`;
  } catch (error) {
    tellError(error);
  }
}

/** The wave is faster along fibres. */
export function slowAcross(kind: TissueKind): void {
  kind.across_mm_per_ms = Number((acrossShare * kind.along_mm_per_ms).toPrecision(2));
}

export function startingPhysics(current: Recipe): Physics {
  const labels = meshedLabels(current);
  const conducting = labels.filter((label) => !noTissue.test(nameOf(label)) || slow.test(nameOf(label)));
  const healthy = conducting.filter((label) => !slow.test(nameOf(label)));
  const border = conducting.filter((label) => slow.test(nameOf(label)));
  const physics = groupDefaults<Physics>('physics');
  physics.tissue.kinds = [newTissue(healthy.length > 0 ? healthy : labels)];
  if (healthy.length > 0 && border.length > 0)
    physics.tissue.kinds.push({ labels: border, ...tissuePresets.border.fields });
  if (fibresAreGiven.value) physics.tissue.kinds.forEach(slowAcross);
  physics.stimuli = [newStimulus(0)];
  physics.monodomain = { ...groupDefaults<MonodomainParams>('physics.monodomain'), step_ms: 0.1 };
  return physics;
}

/** Adds tissue, a stimulus and a wave; what else is simulated stays. */
export function excite(draft: Recipe): void {
  const { tissue, stimuli, monodomain } = startingPhysics(draft);
  if (draft.physics?.fibres) tissue.kinds.forEach(slowAcross);
  draft.physics = { ...(draft.physics ?? groupDefaults<Physics>('physics')), tissue, stimuli, monodomain };
}

/** The recipe asks for a simulation from now on. */
export function addSimulation(): void {
  editRecipe('Add simulation', excite);
}

/** The heart beats from now on, with what it needs for that: where its cavities are, and its fibres. */
export function addHeartbeat(): void {
  editRecipe('Add heartbeat', (draft) => {
    draft.physics ??= groupDefaults<Physics>('physics');
    const { physics } = draft;
    physics.anatomy ??= groupDefaults('physics.anatomy');
    if (!fibresAreGiven.value && !physics.fibres) {
      physics.fibres = groupDefaults('physics.fibres');
      physics.tissue.kinds.forEach(slowAcross);
    }
    physics.mechanics = { ...groupDefaults<BeatParams>('physics.mechanics'), material: {} };
    // Without a wave all muscle contracts at once.
    if (physics.tissue.kinds.length === 0) physics.mechanics.contraction.by = 'synchronous';
  });
}
