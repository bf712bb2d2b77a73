import type { Vec3 } from '../../engine/contract';
import { pinned } from '../../store/run/compare';
import { writeFiles } from '../controls/write_files';
import { nameOf } from '../../store/case/input';
import { recipe } from '../../store/case/recipe';
import { beatShown, showBeat, simulatedFields } from '../../store/run/simulated_fields';
import { shownResult } from '../../store/run/results';
import { report } from '../../store/run/report';
import {
  brush,
  colourBy,
  command,
  cut,
  explode,
  focusTet,
  fractionLabel,
  layout,
  picked,
  showEdges,
  sliceLegend,
  sliceOverlay,
  slicePlaces,
  stageShown,
  type ColourBy,
  type SliceOverlay,
} from '../../store/view';
import { Segments } from '../controls/fields';
import { Icon } from '../controls/icons';
import { fetched } from '../controls/fetched';
import { ScaleStrip } from './view_cards';

const cutAxes: [string, string, Vec3][] = [
  ['R', 'Cut from right to left', [1, 0, 0]],
  ['A', 'Cut from front to back', [0, 1, 0]],
  ['S', 'Cut from head to feet', [0, 0, 1]],
];

/** Every field that the evidence has, and those that are played, in the engine's words. */
function fieldOptions(): [ColourBy, string][] {
  const fields = shownResult('quality')?.fields ?? [];
  const played = simulatedFields.value.map(({ info: { name, title } }): [ColourBy, string] => [name, title]);
  const measured = fields.map(({ name, title, unit, on }): [ColourBy, string] => {
    const label = fractionLabel(name);
    if (label !== null) return [name, `Share of ${nameOf(label)}`];
    return [name, on === 'points' ? `${title}, ${unit}` : title];
  });
  return [...measured, ...played];
}

function ColourChoice() {
  const onTets = stageShown.value === 'optimise' || stageShown.value === 'quality';
  const options: [ColourBy, string][] = [['label', 'Label']];
  if (onTets) options.push(...fieldOptions());
  else {
    options.push(['edge_mm', 'Mean edge length'], ['target_mm', 'Target edge length']);
    if (recipe.value?.sizing.thickness.length) options.push(['thickness_mm', 'Wall thickness']);
  }
  const chosen = options.some(([value]) => value === colourBy.value) ? colourBy.value : 'label';
  return (
    <label class="tool-field">
      <select
        aria-label="Colour by"
        value={chosen}
        onChange={(event) => (colourBy.value = event.currentTarget.value as ColourBy)}
      >
        {options.map(([value, text]) => (
          <option key={value} value={value} selected={value === chosen}>
            {text}
          </option>
        ))}
      </select>
    </label>
  );
}

/** Which activation of each point, where some were activated again. */
function BeatTool() {
  const { beat, count } = beatShown.value;
  if (count < 2) return null;
  return (
    <label class="tool-field explode" title="Which activation of each point">
      <span>Beat {beat}</span>
      <input
        type="range"
        min={1}
        max={count}
        value={beat}
        aria-label="Beat"
        onInput={(event) => showBeat(Number(event.currentTarget.value))}
      />
    </label>
  );
}

function CutDirection() {
  const { normal } = cut.value;
  const axis = cutAxes.find(
    ([, , direction]) =>
      direction.every((part, i) => part === normal[i]) || direction.every((part, i) => -part === normal[i]),
  );
  return (
    <div class="segments" role="group" aria-label="Direction of the cut">
      {cutAxes.map(([name, title, direction]) => (
        <button
          type="button"
          key={name}
          title={title}
          aria-label={title}
          aria-pressed={axis?.[0] === name}
          onClick={() => (cut.value = { ...cut.value, normal: direction })}
        >
          {name}
        </button>
      ))}
      <button
        type="button"
        title="Cut facing me"
        aria-pressed={!axis}
        onClick={() => (command.value = { kind: 'cut_facing_me' })}
      >
        View
      </button>
    </div>
  );
}

function CutTools({ onTets }: { onTets: boolean }) {
  const { on, flat, normal, place } = cut.value;
  return (
    <>
      <button
        type="button"
        class="tool"
        aria-pressed={on}
        title="Cut the body open (C)"
        onClick={() => (cut.value = { ...cut.value, on: !on })}
      >
        Cut
      </button>
      {on && (
        <div class="cut-tools">
          {onTets && (
            <Segments
              label="What the cut leaves"
              value={flat ? 'flat' : 'whole'}
              options={[
                ['whole', 'Whole', 'Tetrahedra stay whole'],
                ['flat', 'Flat', 'The plane goes through tetrahedra'],
              ]}
              onChange={(kind) => (cut.value = { ...cut.value, flat: kind === 'flat' })}
            />
          )}
          <CutDirection />
          <input
            type="range"
            min={0}
            max={1}
            step={0.005}
            value={place}
            aria-label="Place of the cut"
            onInput={(event) => (cut.value = { ...cut.value, place: Number(event.currentTarget.value) })}
          />
          <button
            type="button"
            class="tool"
            title="Keep the other side"
            onClick={() =>
              (cut.value = {
                ...cut.value,
                normal: normal.map((part) => -part || 0) as Vec3,
                place: 1 - place,
              })
            }
          >
            Flip
          </button>
        </div>
      )}
    </>
  );
}

function ExplodeTool() {
  const labels = new Set(report.value?.fidelity.labels.map(({ label }) => label));
  if (labels.size < 2) return null;
  return (
    <label class="tool-field explode" title="Pull the labels apart">
      <span>Apart</span>
      <input
        type="range"
        min={0}
        max={1.5}
        step={0.02}
        value={explode.value}
        aria-label="Pull the labels apart"
        onInput={(event) => (explode.value = Number(event.currentTarget.value))}
      />
    </label>
  );
}

/** Where the slices stand, while they are planes in the 3-D view only. */
function PlaneTools() {
  return (
    <div class="slice-tools">
      {['i', 'j', 'k'].map((name, axis) => (
        <label key={name}>
          <span>{name}</span>
          <input
            type="range"
            min={0}
            max={1}
            step={0.005}
            value={slicePlaces.value[axis]}
            aria-label={`Slice along image axis ${name}`}
            onInput={(event) => {
              const place = Number(event.currentTarget.value);
              slicePlaces.value = slicePlaces.value.map((old, i) => (i === axis ? place : old)) as Vec3;
            }}
          />
        </label>
      ))}
    </div>
  );
}

/** The way back from single elements, over the view: the toolbar keeps its height. */
export function ShowAll() {
  if ((focusTet.value === null && brush.value === null) || !report.value) return null;
  return (
    <button
      type="button"
      class="tool show-all"
      onClick={() => {
        focusTet.value = null;
        brush.value = null;
        picked.value = null;
        command.value = { kind: 'fit' };
      }}
    >
      Show all
    </button>
  );
}

const FibreTool = fetched(() => import('./fibre_tool').then((part) => part.FibreTool));

export function ViewToolbar() {
  const stage = stageShown.value;
  const planes = stage === 'volume' || stage === 'sizing';
  const onTets = stage === 'optimise' || stage === 'quality';
  const sliced = layout.value === 'slices';
  return (
    <div class="toolbar" role="toolbar" aria-label="View tools">
      <Segments
        label="Layout"
        value={layout.value}
        options={[
          ['model', '3-D', 'One view (1)'],
          ['slices', 'Slices', 'Three slices of the image beside it (2)'],
          ...(pinned.value ? [['compare', 'Compare', 'The pinned run beside it (3)'] as const] : []),
        ]}
        onChange={(next) => (layout.value = next)}
      />
      {!planes && <ColourChoice />}
      {onTets && <BeatTool />}
      <button
        type="button"
        class="tool"
        aria-pressed={showEdges.value}
        title="Element edges (E)"
        onClick={() => (showEdges.value = !showEdges.value)}
      >
        Edges
      </button>
      {!planes && <CutTools onTets={onTets} />}
      {onTets && recipe.value?.physics?.fibres && report.value && <FibreTool />}
      {onTets && <ExplodeTool />}
      {planes && !sliced && <PlaneTools />}
      <button
        type="button"
        class="tool icon-only"
        title="Fit to view (F)"
        aria-label="Fit to view"
        onClick={() => (command.value = { kind: 'fit' })}
      >
        <Icon name="fit" />
      </button>
      <button
        type="button"
        class="tool icon-only"
        title="Save a picture of the view (P)"
        aria-label="Save a picture of the view"
        onClick={() => writeFiles(({ downloadPicture }) => downloadPicture())}
      >
        <Icon name="picture" />
      </button>
    </div>
  );
}

/** What the slices show, in their corner. */
export function SliceChoice() {
  if (layout.value !== 'slices') return null;
  const options: [SliceOverlay, string, string?][] = [
    ['labels', 'Labels'],
    ['size', 'Edge length', 'The target edge length at every place'],
  ];
  if (recipe.value?.sizing.thickness.length)
    options.push(['thickness', 'Thickness', 'How thick the walls are']);
  const onField = stageShown.value === 'sizing';
  const known = options.some(([value]) => value === sliceOverlay.value) ? sliceOverlay.value : 'size';
  return (
    <div class="slice-choice">
      <Segments
        label="Slices show"
        value={onField && known === 'labels' ? 'size' : known}
        disabled={onField ? ['labels'] : []}
        options={options}
        onChange={(next) => (sliceOverlay.value = next)}
      />
      {sliceLegend.value && <ScaleStrip shown={sliceLegend.value} />}
    </div>
  );
}
