import type {
  Electrode,
  FibreParams,
  MonodomainParams,
  Physics,
  Recipe,
  Stimulus,
  TissueKind,
} from '../../engine/contract';
import { movedRegion } from '../../geometry/regions';
import { fibresAreGiven } from '../../store/case/input';
import { addSimulation, meshedLabels, newStimulus, newTissue, slowAcross } from '../../store/case/physics';
import { editRecipe } from '../../store/case/recipe';
import { upToDate } from '../../store/run/report';
import { groupDefaults } from '../../store/run/schema_defaults';
import { simulate } from '../../store/run/simulate';
import { activity } from '../../store/run/stages';
import { crosshairMm } from '../../store/view_place';
import { CheckField, SelectField, VectorField } from '../controls/fields';
import { short } from '../controls/format';
import { RemoveButton } from '../controls/folded_item';
import { Icon } from '../controls/icons';
import { SizeList } from '../controls/size_list';
import { BodyFields, BodyHandles, BodyShape } from '../controls/body_fields';
import { BeatSection } from './beat_section';
import { Findings } from './findings';
import { editPhysics, numbersOf } from './physics_fields';
import { TissueFields } from './tissue_fields';
import { nameOf } from '../../store/case/legend/legend';

const presets: Record<string, [string, number, number, number, number]> = {
  cemrg: ['60 to −60° (CEMRG)', 60, -60, -65, 25],
  bayer: ['40 to −50° (Bayer 2012)', 40, -50, -65, 25],
  strocchi: ['80 to −60° (Strocchi 2020)', 80, -60, -65, 25],
  kit: ['60 to −60°, sheets 45° (KIT)', 60, -60, -45, 45],
};

function presetOf(params: FibreParams): string {
  const { alpha_endo_deg, alpha_epi_deg, beta_endo_deg, beta_epi_deg } = params;
  const angles = [alpha_endo_deg, alpha_epi_deg, beta_endo_deg, beta_epi_deg];
  return (
    Object.keys(presets).find((name) => angles.every((angle, i) => angle === presets[name][i + 1])) ?? ''
  );
}

function FibreFields({ params }: { params: FibreParams }) {
  const set = (label: string, change: Partial<FibreParams>) =>
    editPhysics(label, `fibres ${label}`, ({ fibres }) => void (fibres && Object.assign(fibres, change)));
  const number = numbersOf('physics.fibres', 'Fibres', params, set);
  const preset = presetOf(params);
  const options = Object.entries(presets).map(([name, [title]]) => [name, title] as const);
  return (
    <>
      <SelectField
        label="Angles"
        value={preset}
        options={preset ? options : [['', 'Own angles'], ...options]}
        onChange={(name) => {
          const [, alpha_endo_deg, alpha_epi_deg, beta_endo_deg, beta_epi_deg] = presets[name];
          set('Angles of fibres', { alpha_endo_deg, alpha_epi_deg, beta_endo_deg, beta_epi_deg });
        }}
      />
      <details class="more">
        <summary>Rule and angles</summary>
        <SelectField
          label="Rule"
          value={params.rule}
          options={[
            ['linear', 'Linear in depth'],
            ['bayer', 'Bayer et al. 2012'],
          ]}
          onChange={(rule) => set('Rule', { rule })}
        />
        {number('Helix, inside', 'alpha_endo_deg', '°', 5)}
        {number('Helix, outside', 'alpha_epi_deg', '°', 5)}
        {number('Sheet, inside', 'beta_endo_deg', '°', 5)}
        {number('Sheet, outside', 'beta_epi_deg', '°', 5)}
      </details>
    </>
  );
}

function StimulusFields({ stimulus, index, name }: { stimulus: Stimulus; index: number; name: string }) {
  const body = { kind: 'stimulus', index } as const;
  const set = (label: string, change: Partial<Stimulus>) =>
    editPhysics(
      label,
      `stimulus ${index} ${label}`,
      ({ stimuli }) => void Object.assign(stimuli[index], change),
    );
  const number = numbersOf('physics.stimuli', name, stimulus, set);
  return (
    <>
      <BodyHandles shape={stimulus.shape} />
      <BodyShape body={body} region={stimulus} />
      <BodyFields body={body} region={stimulus} path="physics.stimuli" owner={name} />
      <button
        type="button"
        class="button small"
        title="Moves the stimulus to the crosshair of the slices"
        onClick={() => {
          const change = movedRegion(
            stimulus,
            crosshairMm().map((x, axis) => x - stimulus.centre_mm[axis]),
          );
          set('Move stimulus', change);
        }}
      >
        <Icon name="target" size={13} /> To the crosshair
      </button>
      {number('Start', 'start_ms', 'ms', 10)}
      {number('Beats (S1)', 'count', '', 1)}
      {stimulus.count > 1 && number('Every', 'interval_ms', 'ms', 10)}
      {number('S2 after', 's2_ms', 'ms', 10)}
      {stimulus.s2_ms > 0 && number('S3 after', 's3_ms', 'ms', 10)}
      <details class="more">
        <summary>Current</summary>
        {number('Duration', 'duration_ms', 'ms', 0.5)}
        {number('Strength', 'strength_per_ms', '1/ms', 0.1)}
      </details>
    </>
  );
}

function WaveFields({ params }: { params: MonodomainParams }) {
  const set = (label: string, change: Partial<MonodomainParams>) =>
    editPhysics(
      label,
      `wave ${label}`,
      ({ monodomain }) => void (monodomain && Object.assign(monodomain, change)),
    );
  const number = numbersOf('physics.monodomain', 'Wave', params, set);
  return (
    <>
      {number('Until', 'end_ms', 'ms', 50)}
      <details class="more">
        <summary>Time steps</summary>
        {number('Step', 'step_ms', 'ms', 0.01)}
        {number('Frame every', 'frame_ms', 'ms', 1)}
        <SelectField
          label="Integration"
          value={params.integration}
          options={[
            ['semi_implicit', 'Semi-implicit, for results'],
            ['explicit', 'Explicit, for a quick look'],
          ]}
          onChange={(integration) => set('Integration', { integration })}
        />
        <CheckField
          label="Correct the speed for the mesh"
          hint="Coarse tetrahedra slow or hurry a wave; each tetrahedron's conductivity is changed by what was measured of that."
          checked={params.correct_speed}
          onChange={(correct_speed) => set('Speed for the mesh', { correct_speed })}
        />
      </details>
    </>
  );
}

function ElectrodeFields({ electrode, index }: { electrode: Electrode; index: number }) {
  const set = (label: string, change: Partial<Electrode>) =>
    editPhysics(
      label,
      `electrode ${index} ${label}`,
      ({ monodomain }) => void (monodomain && Object.assign(monodomain.electrodes[index], change)),
    );
  return (
    <>
      <VectorField
        label="Place"
        unit="mm"
        value={electrode.at_mm}
        onChange={(at_mm) => set('Move electrode', { at_mm })}
      />
      <button
        type="button"
        class="button small"
        title="Moves the electrode to the crosshair of the slices"
        onClick={() => set('Move electrode', { at_mm: crosshairMm() })}
      >
        <Icon name="target" size={13} /> To the crosshair
      </button>
    </>
  );
}

function RunButtons() {
  const ready = upToDate.value && activity.value === 'idle';
  const wait = upToDate.value ? '' : ' (run the mesh first)';
  return (
    <div class="run-buttons">
      <button
        type="button"
        class="button"
        data-testid="activation-map"
        disabled={!ready}
        title={`When the first wave comes to each point, at once, by the eikonal equation${wait}`}
        onClick={() => void simulate('eikonal')}
      >
        Activation map
      </button>
      <button
        type="button"
        class="button primary"
        data-testid="simulate-wave"
        disabled={!ready}
        title={`The excitation wave with its recovery, played as it is computed${wait}`}
        onClick={() => void simulate('monodomain')}
      >
        <Icon name="play" size={13} /> Simulate
      </button>
    </div>
  );
}

function PhysicsFields({ current, physics }: { current: Recipe; physics: Physics }) {
  const { fibres, tissue, monodomain } = physics;
  const toggleFibres = (on: boolean) =>
    editPhysics('Fibres', 'fibres', (draft) => {
      if (on) {
        draft.anatomy = groupDefaults('physics.anatomy');
        draft.fibres = groupDefaults('physics.fibres');
        draft.tissue.kinds.forEach(slowAcross);
      } else {
        delete draft.fibres;
        delete draft.anatomy;
      }
    });
  const used = tissue.kinds.flatMap(({ labels }) => labels);
  const still = meshedLabels(current).filter((label) => !used.includes(label));
  return (
    <>
      <SizeList<TissueKind>
        title="Tissue"
        kind="Kind"
        hint="Labels without a kind do not conduct."
        of={(recipe) => recipe.physics?.tissue.kinds ?? []}
        current={current}
        fresh={() => newTissue(still)}
        nameOf={({ labels }) => labels.map(nameOf).join(', ') || 'No label'}
        noteOf={({ along_mm_per_ms }) => `${short(along_mm_per_ms)} m/s`}
        fields={(kind, index, name) => (
          <TissueFields
            kind={kind}
            index={index}
            name={name}
            taken={used.filter((label) => !kind.labels.includes(label))}
            fibres={fibres !== undefined || fibresAreGiven.value}
          />
        )}
      />
      {still.length > 0 && <p class="hint">Conduct nothing: {still.map(nameOf).join(', ')}.</p>}
      <CheckField
        label="Fibres by rule"
        checked={fibres !== undefined}
        hint={
          fibresAreGiven.value
            ? 'In the place of those that came with the mesh.'
            : 'Muscle fibres turn through the wall; the wave is faster along them. For hearts with two ventricles or one.'
        }
        onChange={toggleFibres}
      />
      {fibres && <FibreFields params={fibres} />}
      <SizeList<Stimulus>
        body="stimulus"
        title="Stimuli"
        kind="Stimulus"
        hint="Where and when the wave starts. Drag them in the 3-D view or on the slices."
        of={(recipe) => recipe.physics?.stimuli ?? []}
        current={current}
        fresh={() => newStimulus(physics.stimuli.length)}
        nameOf={({ name }) => name || 'Stimulus'}
        noteOf={({ start_ms, count }) => (count > 1 ? `${count} beats` : `${short(start_ms)} ms`)}
        fields={(stimulus, index, name) => <StimulusFields stimulus={stimulus} index={index} name={name} />}
      />
      {monodomain && <WaveFields params={monodomain} />}
      <SizeList<Electrode>
        body="electrode"
        title="Electrodes"
        kind="Electrode"
        hint="Places where the potential is recorded: on the heart, or away from it as a lead of an ECG."
        of={(recipe) => recipe.physics?.monodomain?.electrodes ?? []}
        current={current}
        fresh={() => ({
          name: `Electrode ${(monodomain?.electrodes.length ?? 0) + 1}`,
          at_mm: crosshairMm(),
        })}
        nameOf={({ name }) => name || 'Electrode'}
        noteOf={({ at_mm }) => at_mm.map((x) => x.toFixed(0)).join(', ')}
        fields={(electrode, index) => <ElectrodeFields electrode={electrode} index={index} />}
      />
      <RunButtons />
      <Findings />
    </>
  );
}

/** The heart's excitation on the mesh, and its beat. */
export function PhysicsSection({ current, physics }: { current: Recipe; physics: Physics }) {
  return (
    <section class="section">
      <div class="section-head">
        <h2>Physics</h2>
        <RemoveButton
          what="simulation"
          onRemove={() => editRecipe('Remove simulation', (draft) => void delete draft.physics)}
        />
      </div>
      {physics.monodomain ? (
        <PhysicsFields current={current} physics={physics} />
      ) : (
        <div class="regions-head">
          <h3>Excitation</h3>
          <button type="button" class="button small" onClick={addSimulation}>
            <Icon name="plus" size={13} /> Excitation
          </button>
        </div>
      )}
      <BeatSection current={current} />
      <p class="hint">
        How right is this? <a href="./verification.html">Checks that run here</a>, beside closed forms and
        other codes.
      </p>
    </section>
  );
}
