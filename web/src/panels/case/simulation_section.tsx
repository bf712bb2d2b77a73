import type { DiffusionParams, Physics, Recipe } from '../../engine/contract';
import { volume } from '../../store/case/input';
import { editRecipe } from '../../store/case/recipe';
import { upToDate } from '../../store/run/report';
import { simulate } from '../../store/run/simulate';
import { groupDefaults } from '../../store/run/schema_defaults';
import { activity } from '../../store/run/stages';
import { CheckField, NumberField, SelectField } from '../controls/fields';
import { Icon } from '../controls/icons';
import { nameOf } from '../../store/case/legend/legend';

type NumberKey = 'diffusivity_mm2_per_ms' | 'end_ms' | 'step_ms' | 'frame_ms';

const group = 'physics.diffusion.';

/** The engine's own values, but for the label, which has to be one that is meshed. */
const startingParams = (from: number): DiffusionParams => ({
  ...groupDefaults<DiffusionParams>('physics.diffusion'),
  from,
});

function DiffusionFields({ params, labels }: { params: DiffusionParams; labels: readonly number[] }) {
  const set = (change: Partial<DiffusionParams>, label: string) =>
    editRecipe(
      label,
      (draft) => void (draft.physics?.diffusion && Object.assign(draft.physics.diffusion, change)),
      `diffusion ${label}`,
    );
  const number = (label: string, key: NumberKey, unit = '') => (
    <NumberField
      label={label}
      owner="Diffusion"
      path={group + key}
      unit={unit}
      value={params[key]}
      onChange={(value) => set({ [key]: value }, label)}
    />
  );
  return (
    <>
      <SelectField
        label="From"
        value={String(params.from)}
        options={labels.map((label) => [String(label), nameOf(label)] as const)}
        hint="Label from which heat spreads"
        onChange={(label) => set({ from: Number(label) }, 'From')}
      />
      {number('Diffusivity, mm²/ms', 'diffusivity_mm2_per_ms')}
      {number('Until', 'end_ms', 'ms')}
      {number('Step', 'step_ms', 'ms')}
      {number('Frame every', 'frame_ms', 'ms')}
      <button
        type="button"
        class="button"
        data-testid="simulate"
        disabled={!upToDate.value || activity.value !== 'idle'}
        title={upToDate.value ? 'Compute on the mesh, and play it' : 'Run the mesh first'}
        onClick={() => void simulate('diffusion')}
      >
        <Icon name="play" size={13} /> Simulate
      </button>
    </>
  );
}

/** What is computed on the mesh. For developers: a test of all that lives in time. */
export function SimulationSection({ current }: { current: Recipe }) {
  const known = volume.value?.labels.map(({ label }) => label) ?? [];
  const labels = current.labels.length > 0 ? current.labels : known;
  const params = current.physics?.diffusion;
  const toggle = (on: boolean) =>
    editRecipe('Heat diffusion', (draft) => {
      const physics = draft.physics ?? groupDefaults<Physics>('physics');
      if (on) physics.diffusion = startingParams(labels[0]);
      else delete physics.diffusion;
      draft.physics = physics;
    });
  return (
    <section class="section">
      <h2>
        Simulation <span class="tag">developer</span>
      </h2>
      <CheckField
        label="Heat diffusion"
        checked={params !== undefined}
        hint="Heat that spreads from a label through the mesh"
        onChange={toggle}
      />
      {params && <DiffusionFields params={params} labels={labels} />}
    </section>
  );
}
