import type { Recipe, RegionShape, SizeRegion } from '../../engine/contract';
import { volume } from '../../store/case/input';
import { editRecipe } from '../../store/case/recipe';
import { gizmoMode, regionShown } from '../../store/view';
import { crosshairMm } from '../../store/view_place';
import { NumberField, Segments, SelectField, VectorField } from '../controls/fields';
import { FoldedItem } from '../controls/folded_item';
import { Icon } from '../controls/icons';

/** How long the image is, mm. */
function imageExtent(): number {
  const known = volume.value;
  return known ? Math.max(...known.size.map((size, axis) => size * known.spacing_mm[axis])) : 60;
}

function newRegion(shape: RegionShape, current: Recipe): SizeRegion {
  const centre = crosshairMm();
  const radius = Math.max(1, Math.round(imageExtent() / 8));
  const edge = Number((current.sizing.edge_mm / 2).toPrecision(2));
  return {
    name: `Region ${current.sizing.regions.length + 1}`,
    shape,
    centre_mm: centre,
    end_mm: [centre[0], centre[1], centre[2] + 2 * radius],
    half_size_mm: [radius, radius, radius],
    axes_deg: [0, 0, 0],
    radius_mm: radius,
    edge_mm: edge,
    band_mm: 5,
  };
}

const shapes: readonly (readonly [RegionShape, string])[] = [
  ['sphere', 'Sphere'],
  ['box', 'Box'],
  ['capsule', 'Capsule'],
];

function RegionFields({ region, index }: { region: SizeRegion; index: number }) {
  const set = (label: string, change: Partial<SizeRegion>) =>
    editRecipe(
      label,
      (draft) => void Object.assign(draft.sizing.regions[index], change),
      `region ${index} ${label}`,
    );
  const number = (label: string, key: 'edge_mm' | 'band_mm' | 'radius_mm', step: number) => (
    <NumberField
      label={label}
      owner={region.name}
      unit="mm"
      path={`sizing.regions.${key}`}
      step={step}
      value={region[key]}
      onChange={(value) => set(label, { [key]: value })}
    />
  );
  const modes = (
    region.shape === 'box'
      ? [
          ['translate', 'Move'],
          ['rotate', 'Turn'],
          ['scale', 'Resize'],
        ]
      : region.shape === 'sphere'
        ? [
            ['translate', 'Move'],
            ['scale', 'Resize'],
          ]
        : [['translate', 'Move']]
  ) as ['translate' | 'rotate' | 'scale', string][];
  return (
    <>
      <Segments
        label="Handle in the view"
        value={gizmoMode.value}
        options={modes}
        onChange={(mode) => (gizmoMode.value = mode)}
      />
      <div class="field">
        <span class="field-label">Name</span>
        <span class="field-input wide">
          <input
            type="text"
            aria-label="Region name"
            maxLength={60}
            value={region.name}
            onInput={(event) => set('Name of region', { name: event.currentTarget.value })}
          />
        </span>
      </div>
      <SelectField
        label="Shape"
        value={region.shape}
        options={shapes}
        onChange={(shape) => set('Shape of region', { shape })}
      />
      {number('Edge inside', 'edge_mm', 0.1)}
      {number('Transition', 'band_mm', 1)}
      {region.shape !== 'box' && number('Radius', 'radius_mm', 1)}
      <VectorField
        label={region.shape === 'capsule' ? 'From' : 'Centre'}
        unit="mm"
        value={region.centre_mm}
        onChange={(centre_mm) => set('Move region', { centre_mm })}
      />
      {region.shape === 'capsule' && (
        <VectorField
          label="To"
          unit="mm"
          value={region.end_mm}
          onChange={(end_mm) => set('Move region end', { end_mm })}
        />
      )}
      {region.shape === 'box' && (
        <>
          <VectorField
            label="Half size"
            unit="mm"
            names={['1', '2', '3']}
            path="sizing.regions.half_size_mm"
            value={region.half_size_mm}
            onChange={(half_size_mm) => set('Resize region', { half_size_mm })}
          />
          <VectorField
            label="Rotation"
            unit="°"
            names={['R', 'A', 'S']}
            path="sizing.regions.axes_deg"
            value={region.axes_deg}
            onChange={(axes_deg) => set('Turn region', { axes_deg })}
          />
        </>
      )}
    </>
  );
}

export function RegionList({ current }: { current: Recipe }) {
  const add = (shape: RegionShape) => {
    editRecipe(`Add ${shape}`, (draft) => void draft.sizing.regions.push(newRegion(shape, current)));
    regionShown.value = current.sizing.regions.length;
    gizmoMode.value = 'translate';
  };
  const remove = (index: number) => {
    regionShown.value = null;
    editRecipe('Remove region', (draft) => void draft.sizing.regions.splice(index, 1));
  };
  return (
    <div class="regions">
      <div class="regions-head">
        <h3>Regions</h3>
        <span>
          <button type="button" class="button small" onClick={() => add('sphere')}>
            <Icon name="plus" size={13} /> Sphere
          </button>
          <button type="button" class="button small" onClick={() => add('box')}>
            <Icon name="plus" size={13} /> Box
          </button>
          <button type="button" class="button small" onClick={() => add('capsule')}>
            <Icon name="plus" size={13} /> Capsule
          </button>
        </span>
      </div>
      {current.sizing.regions.length === 0 && (
        <p class="hint">
          A body with its own edge length, placed at the crosshair. Drag it in the 3-D view or on the slices.
        </p>
      )}
      {current.sizing.regions.map((region, index) => {
        const open = regionShown.value === index;
        return (
          <FoldedItem
            key={index}
            name={region.name || `Region ${index + 1}`}
            note={`${region.edge_mm} mm`}
            open={open}
            onToggle={() => (regionShown.value = open ? null : index)}
            onRemove={() => remove(index)}
          >
            <RegionFields region={region} index={index} />
          </FoldedItem>
        );
      })}
    </div>
  );
}
