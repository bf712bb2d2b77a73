import type { Recipe } from '../../../engine/contract';
import { addRegion, isChosen } from '../../../store/case/bodies';
import { crosshairMm } from '../../../store/view_place';
import { editRecipe } from '../../../store/case/recipe';
import { bodyShown } from '../../../store/view';
import { fetched } from '../../controls/fetched';
import { FoldedItem } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';

/** Fields of the region that is open; few cases have one. */
const RegionFields = fetched(() => import('./region_fields').then((part) => part.RegionFields));

export function RegionList({ current }: { current: Recipe }) {
  const remove = (index: number) => {
    bodyShown.value = null;
    editRecipe('Remove region', (draft) => void draft.sizing.regions.splice(index, 1));
  };
  return (
    <div class="regions">
      <div class="regions-head">
        <h3>Regions</h3>
        <span>
          <button type="button" class="button small" onClick={() => addRegion('sphere', crosshairMm())}>
            <Icon name="plus" size={13} /> Sphere
          </button>
          <button type="button" class="button small" onClick={() => addRegion('box', crosshairMm())}>
            <Icon name="plus" size={13} /> Box
          </button>
          <button type="button" class="button small" onClick={() => addRegion('capsule', crosshairMm())}>
            <Icon name="plus" size={13} /> Capsule
          </button>
        </span>
      </div>
      {current.sizing.regions.length === 0 && (
        <p class="hint">
          A body with its own edge length, at the crosshair; a double click on the body or a slice puts a
          sphere there. Drag it in the 3-D view or on the slices.
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
