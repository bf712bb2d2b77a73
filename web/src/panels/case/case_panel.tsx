import type { Recipe } from '../../engine/contract';
import { tellError } from '../../store/run/engine';
import { forecast } from '../../store/run/forecast';
import { awaitedFile, meshIsGiven, volume } from '../../store/case/input';
import { unnamed } from '../../store/case/legend/legend';
import { likelyBackground } from '../../store/case/legend/proposals';
import { developer } from '../../store/developer';
import { editRecipe, hasSource, recipe } from '../../store/case/recipe';
import { mayUse } from '../../store/case/keep/lesson_asked';
import { remoteAsked } from '../../store/case/remote';
import { activity } from '../../store/run/stages';
import { CurvatureList } from './sizes/curvature_list';
import { dialogShown } from '../controls/dialog_shown';
import { Explain } from '../controls/explain';
import { NumberField } from '../controls/fields';
import { Icon } from '../controls/icons';
import { Panel } from '../controls/panel';
import { LabelTable } from './label_table';
import { TransferFields } from './transfer_fields';
import { MergeAllField } from './merge_all_field';
import { PaintSection } from './sizes/paint_section';
import { RegionList } from './sizes/region_list';
import { fetched } from '../controls/fetched';
import { SizeFiles } from './sizes/size_files';
import { SourceSection } from './source_section';
import { StageSection } from './stage_section';
import { WallList } from './sizes/wall_list';

const Naming = fetched(() => import('./naming').then((part) => part.Naming));
const Background = fetched(() => import('./naming').then((part) => part.Background));

function LabelSection({ current }: { current: Recipe }) {
  const known = volume.value;
  if (!known) return null;
  const chosen = current.labels.length > 0 ? current.labels : known.labels.map(({ label }) => label);
  const background = likelyBackground(known, chosen);
  return (
    <section class="section">
      <div class="section-head">
        <h2>Labels</h2>
        <Explain
          of="a row of labels"
          text="Its colour, name and volume; whether it is meshed; the region of the mesh that it goes into, by the number of a label; the target edge length inside it; whether it is seen in the view."
        />
      </div>
      {unnamed.value && <Naming />}
      {background !== null && <Background label={background} />}
      <LabelTable current={current} />
      {chosen.length > 1 && <MergeAllField current={current} chosen={chosen} />}
      <TransferFields current={current} />
    </section>
  );
}

function SizingSection({ current }: { current: Recipe }) {
  const number = (
    label: string,
    key: 'edge_mm' | 'edge_min_mm' | 'edge_max_mm' | 'gradation',
    unit: string,
    step: number,
  ) => (
    <NumberField
      label={label}
      unit={unit}
      path={`sizing.${key}`}
      step={step}
      value={current.sizing[key]}
      onChange={(value) => editRecipe(label, (draft) => void (draft.sizing[key] = value), key)}
    />
  );
  return (
    <section class="section">
      <div class="section-head">
        <h2>Element size</h2>
        <button
          type="button"
          class="button small"
          title="Which edge lengths give so many tetrahedra?"
          disabled={!forecast.value || activity.value !== 'idle'}
          onClick={() => (dialogShown.value = 'sizes')}
        >
          By number…
        </button>
      </div>
      {number('Edge length', 'edge_mm', 'mm', 0.1)}
      {number('Growth per mm', 'gradation', '', 0.05)}
      <RegionList current={current} />
      <WallList current={current} />
      <CurvatureList current={current} />
      <PaintSection />
      <SizeFiles current={current} />
      <details class="more">
        <summary>Bounds</summary>
        {number('Smallest edge', 'edge_min_mm', 'mm', 0.1)}
        {number('Largest edge', 'edge_max_mm', 'mm', 1)}
      </details>
    </section>
  );
}

const CutList = fetched(() => import('./cut_list').then((part) => part.CutList));

/** What is not fetched before it is asked for. */
function AddSection(props: {
  title: string;
  /** What a button says, and what it adds. */
  adds: readonly (readonly [string, () => Promise<void>])[];
  hint?: string;
}) {
  return (
    <section class="section">
      <div class="section-head">
        <h2>{props.title}</h2>
        <span class="section-actions">
          {props.adds.map(([name, add]) => (
            <button key={name} type="button" class="button small" onClick={() => void add()}>
              <Icon name="plus" size={13} /> {name}
            </button>
          ))}
        </span>
      </div>
      {props.hint && <p class="hint">{props.hint}</p>}
    </section>
  );
}

const addCut = () => import('./cut_list').then((part) => part.addCut(), tellError);
const addSimulation = () =>
  import('../../store/case/physics').then((part) => part.addSimulation(), tellError);

const addHeartbeat = () => import('../../store/case/physics').then((part) => part.addHeartbeat(), tellError);

const PhysicsSection = fetched(() =>
  import('../physics/physics_section').then((part) => part.PhysicsSection),
);

const SimulationSection = fetched(() =>
  import('./simulation_section').then((part) => part.SimulationSection),
);

const StackSection = fetched(() => import('./stack_section').then((part) => part.StackSection));

/** Whether the slices are so thick that the engine would interpolate: its tolerance is a thousandth. */
function isStack(sliceRatio: number): boolean {
  const spacing = volume.value?.spacing_mm;
  return spacing !== undefined && Math.max(...spacing) > 1.001 * (sliceRatio || 2) * Math.min(...spacing);
}

export function CasePanel() {
  const current = recipe.value;
  const awaited = awaitedFile.value;
  if (!current) return <Panel part="case" class="left" label="Case" />;
  const { physics } = current;
  const chosen = hasSource(current);
  return (
    <Panel part="case" class="left" label="Case" busy={activity.value === 'opening'}>
      {mayUse('source') && <SourceSection current={current} />}
      {awaited && (
        <p class="hint">
          This case was made from {awaited.name}. Drop that file to go on
          {awaited.url && (
            <>
              , or{' '}
              <button
                type="button"
                class="link-button"
                onClick={() => (remoteAsked.value = { kind: 'volume', url: awaited.url, name: awaited.name })}
              >
                fetch it
              </button>
            </>
          )}
          .
        </p>
      )}
      {chosen && (
        <>
          {mayUse('labels') && <LabelSection current={current} />}
          {!meshIsGiven.value && mayUse('sizes') && <SizingSection current={current} />}
          {!meshIsGiven.value && mayUse('volume') && isStack(current.volume.slice_ratio) && (
            <StackSection current={current} />
          )}
          {!meshIsGiven.value &&
            mayUse('cuts') &&
            (current.volume.cut.length > 0 ? (
              <CutList current={current} />
            ) : (
              <AddSection title="Flat cuts" adds={[['Plane', addCut]]} />
            ))}
          {!meshIsGiven.value && <StageSection current={current} />}
          {mayUse('physics') &&
            (physics?.monodomain || physics?.mechanics ? (
              <PhysicsSection current={current} physics={physics} />
            ) : (
              <AddSection
                title="Physics"
                adds={[
                  ['Simulate', addSimulation],
                  ['Heartbeat', addHeartbeat],
                ]}
                hint="How excitation spreads through the heart, on this mesh, and how it beats."
              />
            ))}
          {developer && <SimulationSection current={current} />}
        </>
      )}
      {!chosen && (
        <p class="hint">
          Labels, sizes and stage parameters appear here once a volume is open. Files stay on this computer:
          the mesher runs in this tab.
        </p>
      )}
    </Panel>
  );
}
