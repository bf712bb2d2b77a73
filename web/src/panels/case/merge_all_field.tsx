import type { Recipe } from '../../engine/contract';
import { dropIdleSizes, mergesAll } from '../../store/case/labels';
import { editRecipe } from '../../store/case/recipe';
import { previewSoon } from '../../store/run/run_stages';
import { CheckField } from '../controls/fields';

/** All labels in one region of the mesh, or each where the table says. */
export function MergeAllField({ current, chosen }: { current: Recipe; chosen: readonly number[] }) {
  const set = (merge: number[][]) => {
    editRecipe('Merge labels', (draft) => {
      draft.merge = merge;
      dropIdleSizes(draft, chosen);
    });
    previewSoon();
  };
  return (
    <CheckField
      label="Mesh the labels as one region"
      checked={mergesAll(current.merge, chosen)}
      onChange={(merge) => set(merge ? [[...chosen]] : [])}
    />
  );
}
