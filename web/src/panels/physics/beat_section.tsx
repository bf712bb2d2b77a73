import type { BeatParams, Recipe } from '../../engine/contract';
import { addHeartbeat, excite } from '../../store/case/physics';
import { editRecipe } from '../../store/case/recipe';
import { upToDate } from '../../store/run/report';
import { simulate } from '../../store/run/simulate';
import { activity } from '../../store/run/stages';
import { SelectField } from '../controls/fields';
import { fetched } from '../controls/fetched';
import { RemoveButton } from '../controls/folded_item';
import { Icon } from '../controls/icons';
import {
  beatNumbers,
  CirculationFields,
  ContractionFields,
  editBeat,
  MaterialField,
  MuscleFields,
  RegurgitationField,
  SupportFields,
} from './beat_fields';

const BeatFindings = fetched(() => import('./beat_findings').then((part) => part.BeatFindings));

function BeatButton() {
  const ready = upToDate.value && activity.value === 'idle';
  return (
    <div class="run-buttons">
      <button
        type="button"
        class="button primary"
        data-testid="simulate-beat"
        disabled={!ready}
        title={`The heart contracts, ejects and fills, played as it is computed${upToDate.value ? '' : ' (run the mesh first)'}`}
        onClick={() => void simulate('mechanics')}
      >
        <Icon name="play" size={13} /> Let it beat
      </button>
    </div>
  );
}

function BeatFields({ params, current }: { params: BeatParams; current: Recipe }) {
  const number = beatNumbers('', 'Heartbeat', params, (beat) => beat);
  return (
    <>
      <SelectField
        label="Elements"
        value={params.element}
        options={[
          ['p1_anp', 'P1, averaged pressures'],
          ['p1_stabilised', 'P1, stabilised pressures'],
          ['p2', 'P2, slow'],
          ['p1', 'P1, which lock'],
        ]}
        onChange={(element) => editBeat('Elements', (beat) => void (beat.element = element))}
      />
      <MaterialField params={params} />
      <SelectField
        label="Active stress"
        value={params.contraction.preset}
        hint="Published values of how strongly and how fast muscle contracts"
        options={[
          ['fast', 'Fast'],
          ['ambit', 'Ambit'],
          ['elastodynamics', 'Elastodynamics'],
        ]}
        onChange={(preset) => editBeat('Active stress', (beat) => void (beat.contraction.preset = preset))}
      />
      <SelectField
        label="Activated by"
        value={params.contraction.by}
        hint="What makes a place contract: when the wave comes there, or all places at one time"
        options={[
          ['eikonal', 'activation map'],
          ['monodomain', 'simulated wave'],
          ['synchronous', 'time alone'],
        ]}
        onChange={(by) =>
          editRecipe('Activated by', (draft) => {
            const { physics } = draft;
            if (by !== 'synchronous' && physics?.tissue.kinds.length === 0) excite(draft);
            if (physics?.mechanics) physics.mechanics.contraction.by = by;
          })
        }
      />
      {number('Beats', 'beats', '', 1)}
      {number('Period', 'period_ms', 'ms', 50)}
      {number('Step', 'step_ms', 'ms', 1)}
      <RegurgitationField params={params} />
      <MuscleFields params={params} current={current} />
      <ContractionFields params={params} />
      <CirculationFields params={params} />
      <SupportFields params={params} />
      <BeatButton />
      <BeatFindings />
    </>
  );
}

/** The heart that beats on the mesh: what is asked of it, and what it does. */
export function BeatSection({ current }: { current: Recipe }) {
  const params = current.physics?.mechanics;
  return (
    <div class="beat" data-testid="heartbeat">
      <div class="regions-head">
        <h3>Heartbeat</h3>
        {params ? (
          <RemoveButton
            what="heartbeat"
            onRemove={() => editRecipe('Remove heartbeat', ({ physics }) => void delete physics?.mechanics)}
          />
        ) : (
          <button type="button" class="button small" onClick={addHeartbeat}>
            <Icon name="plus" size={13} /> Heartbeat
          </button>
        )}
      </div>
      {params ? (
        <BeatFields params={params} current={current} />
      ) : (
        <p class="hint">How both ventricles contract, eject and fill: pressures, volumes, strains.</p>
      )}
    </div>
  );
}
