import { useState } from 'preact/hooks';
import type { Recipe } from '../engine/contract';
import { previewSoon } from '../store/runs';
import { nameOf } from '../store/input';
import { carrierOf, dropIdleSizes, groupedWith, mergesAll } from '../store/labels';
import { editRecipe } from '../store/recipe';
import { CheckField, SelectField } from './fields';

/** Which labels share a region of the mesh. */
export function MergeFields({ current, chosen }: { current: Recipe; chosen: readonly number[] }) {
  const groups = current.merge;
  const [open, setOpen] = useState(groups.length > 0);
  const set = (merge: number[][]) => {
    editRecipe('Merge labels', (draft) => {
      draft.merge = merge;
      dropIdleSizes(draft, chosen);
    });
    previewSoon();
  };
  const carriers = chosen.filter((label) => carrierOf(groups, label) === label);
  const choicesOf = (label: number) => {
    const shared = groups.find((group) => group[0] === label)?.filter((one) => one !== label) ?? [];
    const own = shared.length > 0 ? `with ${shared.map(nameOf).join(', ')}` : 'of its own';
    const others = carriers.filter((one) => one !== label);
    return [
      [String(label), own] as const,
      ...others.map((one) => [String(one), `with ${nameOf(one)}`] as const),
    ];
  };
  const all = mergesAll(groups, chosen);
  return (
    <>
      <CheckField
        label="Mesh the labels as one region"
        checked={all}
        onChange={(merge) => set(merge ? [[...chosen]] : [])}
      />
      {!all && chosen.length > 2 && (
        <details class="more" open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
          <summary>Join labels to regions</summary>
          <div class="label-scroll">
            {open &&
              chosen.map((label) => (
                <SelectField
                  key={label}
                  label={nameOf(label)}
                  value={String(carrierOf(groups, label))}
                  options={choicesOf(label)}
                  onChange={(other) => set(groupedWith(groups, label, Number(other)))}
                />
              ))}
          </div>
        </details>
      )}
    </>
  );
}
