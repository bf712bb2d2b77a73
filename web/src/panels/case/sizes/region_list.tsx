import type { Recipe, RegionShape, SizeRegion } from '../../../engine/contract';
import { volume } from '../../../store/case/input';
import { isChosen } from '../../../store/case/bodies';
import { editRecipe } from '../../../store/case/recipe';
import { bodyShown, gizmoMode } from '../../../store/view';
import { crosshairMm } from '../../../store/view_place';
import { fetched } from '../../controls/fetched';
import { FoldedItem } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';

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

/** Fields of the region that is open; few cases have one. */
const RegionFields = fetched(() => import('./region_fields').then((part) => part.RegionFields));

export function RegionList({ current }: { current: Recipe }) {
  const add = (shape: RegionShape) => {
    editRecipe(`Add ${shape}`, (draft) => void draft.sizing.regions.push(newRegion(shape, current)));
    bodyShown.value = { kind: 'region', index: current.sizing.regions.length };
    gizmoMode.value = 'translate';
  };
  const remove = (index: number) => {
    bodyShown.value = null;
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
        const open = isChosen({ kind: 'region', index });
        return (
          <FoldedItem
            key={index}
            name={region.name || `Region ${index + 1}`}
            note={`${region.edge_mm} mm`}
            open={open}
            onToggle={() => (bodyShown.value = open ? null : { kind: 'region', index })}
            onRemove={() => remove(index)}
          >
            <RegionFields region={region} index={index} />
          </FoldedItem>
        );
      })}
    </div>
  );
}
