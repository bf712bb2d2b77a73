import { useState } from 'preact/hooks';
import type { Recipe } from '../../engine/contract';
import type { SliceName } from '../../geometry/orientation';
import { acrossSlice, newCut, surfaceName, turned, type CutPlane } from '../../store/case/cut_planes';
import { volume } from '../../store/case/input';
import { nameOf } from '../../store/case/legend/legend';
import { carriersOf } from '../../store/case/labels';
import { editRecipe } from '../../store/case/recipe';
import { previewSoon } from '../../store/run/run_stages';
import { crosshairMm } from '../../store/view_place';
import { VectorField } from '../controls/fields';
import { FoldedItem } from '../controls/folded_item';
import { Icon } from '../controls/icons';
import { LabelChips } from '../controls/label_chips';

const slices: readonly SliceName[] = ['axial', 'coronal', 'sagittal'];

function edit(label: string, change: (draft: Recipe) => void, key?: string) {
  editRecipe(label, change, key);
  previewSoon();
}

/** Labels that are in no mesh cannot be cut, nor those that others carry. */
function unmeshed(current: Recipe): number[] {
  const all = volume.value?.labels.map(({ label }) => label) ?? [];
  const carriers = carriersOf(current.merge, current.labels.length > 0 ? current.labels : all);
  return all.filter((label) => !carriers.includes(label));
}

function CutFields({ current, cut, index }: { current: Recipe; cut: CutPlane; index: number }) {
  const set = (label: string, change: Partial<CutPlane>) =>
    edit(label, (draft) => void Object.assign(draft.volume.cut[index], change), `cut ${index} ${label}`);
  return (
    <>
      <div class="field">
        <span class="field-label">Name</span>
        <span class="field-input wide">
          <input
            type="text"
            aria-label="Name of the flat surface"
            maxLength={60}
            placeholder={surfaceName(current.volume.cut, index)}
            value={cut.name}
            onInput={(event) =>
              set('Name of cut', { name: event.currentTarget.value.trim().replace(/[^\w-]+/g, '_') })
            }
          />
        </span>
      </div>
      <LabelChips
        legend="Cuts"
        hint="Labels that are cut. None: all. The others stay as they are."
        chosen={cut.labels}
        taken={unmeshed(current)}
        onChange={(labels) => set('Labels of cut', { labels })}
      />
      <VectorField
        label="Point"
        unit="mm"
        path="volume.cut.point_mm"
        step={0.5}
        value={cut.point_mm}
        onChange={(point_mm) => set('Point of cut', { point_mm })}
      />
      <VectorField
        label="Cut away"
        path="volume.cut.normal"
        step={0.05}
        value={cut.normal}
        onChange={(normal) => set('Direction of cut', { normal })}
      />
      <div class="compare-actions">
        <button
          type="button"
          class="button small"
          onClick={() => set('Point of cut', { point_mm: crosshairMm() })}
        >
          To the crosshair
        </button>
        <button
          type="button"
          class="button small"
          onClick={() => set('Direction of cut', { normal: turned(cut.normal) })}
        >
          Other side
        </button>
        {slices.map((slice) => (
          <button
            key={slice}
            type="button"
            class="button small"
            title={`The plane of the ${slice} slice through the crosshair`}
            onClick={() => set('Plane of cut', { point_mm: crosshairMm(), normal: acrossSlice(slice) })}
          >
            As the {slice} slice
          </button>
        ))}
      </div>
    </>
  );
}

/** Adds a plane at the crosshair. */
export function addCut(): void {
  edit('Add cut', ({ volume: { cut } }) => void cut.push(newCut(cut, crosshairMm())));
}

/** Planes that cut labels off. */
export function CutList({ current }: { current: Recipe }) {
  const { cut: cuts } = current.volume;
  const [open, setOpen] = useState<number | null>(cuts.length - 1);
  const add = () => {
    addCut();
    setOpen(cuts.length);
  };
  const remove = (index: number) => {
    setOpen(null);
    edit('Remove cut', (draft) => void draft.volume.cut.splice(index, 1));
  };
  return (
    <section class="section">
      <div class="section-head">
        <h2>Flat cuts</h2>
        <button type="button" class="button small" onClick={add}>
          <Icon name="plus" size={13} /> Plane
        </button>
      </div>
      {cuts.map((cut, index) => (
        <FoldedItem
          key={index}
          name={surfaceName(cuts, index)}
          note={cut.labels.length > 0 ? cut.labels.map(nameOf).join(', ') : 'all labels'}
          open={open === index}
          onToggle={() => setOpen(open === index ? null : index)}
          onRemove={() => remove(index)}
        >
          <CutFields current={current} cut={cut} index={index} />
        </FoldedItem>
      ))}
    </section>
  );
}
