import type { Vec3 } from '../../engine/contract';
import { pinned } from '../../store/run/compare';
import { writeFiles } from '../controls/write_files';
import { fibresAreGiven } from '../../store/case/input';
import { recipe } from '../../store/case/recipe';
import { beatShown, showBeat, simulatedFields } from '../../store/run/simulated_fields';
import { shownResult } from '../../store/run/results';
import { report } from '../../store/run/report';
import {
  brush,
  chooseLayout,
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
import { Segments, Slider } from '../controls/fields';
import { Icon } from '../controls/icons';
import { fetched } from '../controls/fetched';
import { ScaleStrip } from './view_cards';
import { nameOf } from '../../store/case/legend/legend';

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
  const options: [ColourBy, string][] = [['label', 'Label']];
  if (onTets()) options.push(...fieldOptions());
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
      <Slider name="Beat" min={1} max={count} step={1} value={beat} onValue={showBeat} />
    </label>
  );
}

function CutTool() {
  const { on } = cut.value;
  return (
    <button
      type="button"
      class="tool"
      aria-pressed={on}
      title="Cut the body open (C)"
      onClick={() => (cut.value = { ...cut.value, on: !on })}
    >
      Cut
    </button>
  );
}

function ExplodeTool() {
  const labels = new Set(report.value?.source.labels.map(({ label }) => label));
  if (labels.size < 2) return null;
  return (
    <label class="tool-field explode" title="Pull the labels apart">
      <span>Apart</span>
      <Slider
        name="Pull the labels apart"
        max={1.5}
        step={0.02}
        value={explode.value}
        onValue={(next) => (explode.value = next)}
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
          <Slider
            name={`Slice along image axis ${name}`}
            value={slicePlaces.value[axis]}
            onValue={(place) => {
              slicePlaces.value = slicePlaces.value.map((old, i) => (i === axis ? place : old)) as Vec3;
            }}
          />
        </label>
      ))}
    </div>
  );
}

/** The way back from single elements. */
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

const onTets = () => stageShown.value === 'optimise' || stageShown.value === 'quality';
const onPlanes = () => stageShown.value === 'volume' || stageShown.value === 'sizing';

export function ViewToolbar() {
  const planes = onPlanes();
  return (
    <div class="toolbar" role="toolbar" aria-label="View tools">
      <Segments
        label="Layout"
        value={layout.value}
        options={[
          ['model', '3-D', 'One view (1)'],
          ['slices', 'Slices', 'Three slices of the image beside it (2)'],
          ['compare', 'Compare', 'The pinned run beside it (3)'],
        ]}
        disabled={pinned.value ? [] : ['compare']}
        onChange={chooseLayout}
      />
      {!planes && <ColourChoice />}
      <button
        type="button"
        class="tool"
        aria-pressed={showEdges.value}
        title="Element edges (E)"
        onClick={() => (showEdges.value = !showEdges.value)}
      >
        Edges
      </button>
      {!planes && <CutTool />}
      {onTets() && <ExplodeTool />}
    </div>
  );
}

const FibreTool = fetched(() => import('./fibre_tool').then((part) => part.FibreTool));
const CutFields = fetched(() => import('./cut_fields').then((part) => part.CutFields));

/** What belongs to a tool that is on. It lies over the view, which keeps its place. */
export function ToolOptions() {
  const planes = onPlanes();
  const tets = onTets();
  return (
    <div class="tool-options">
      {!planes && cut.value.on && <CutFields onTets={tets} />}
      {tets && <BeatTool />}
      {tets && (recipe.value?.physics?.fibres || fibresAreGiven.value) && report.value && <FibreTool />}
      {planes && layout.value !== 'slices' && <PlaneTools />}
    </div>
  );
}

/** In the corner of the view. */
export function ViewButtons() {
  return (
    <div class="view-buttons">
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
