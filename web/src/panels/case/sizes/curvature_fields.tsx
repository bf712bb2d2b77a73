import type { CurvatureSize, Recipe } from '../../../engine/contract';
import { volume } from '../../../store/case/input';
import { carriersOf } from '../../../store/case/labels';
import { editRecipe } from '../../../store/case/recipe';
import { NumberField } from '../../controls/fields';
import { LabelChips } from '../../controls/label_chips';

/** Only the surfaces of regions of the mesh are there to bend. */
function unmeshed(current: Recipe): number[] {
  const all = volume.value?.labels.map(({ label }) => label) ?? [];
  const carriers = carriersOf(current.merge, current.labels.length > 0 ? current.labels : all);
  return all.filter((label) => !carriers.includes(label));
}

export function CurvatureFields(props: {
  current: Recipe;
  size: CurvatureSize;
  index: number;
  name: string;
}) {
  const { current, size, index, name } = props;
  const set = (label: string, change: Partial<CurvatureSize>) =>
    editRecipe(
      label,
      (draft) => void Object.assign(draft.sizing.curvature[index], change),
      `curvature ${index} ${label}`,
    );
  return (
    <>
      <LabelChips
        legend="Surfaces of"
        hint="Labels whose surfaces count. None: all."
        chosen={size.labels}
        taken={unmeshed(current)}
        onChange={(labels) => set('Labels of curvature', { labels })}
      />
      <NumberField
        label="Edges to a full turn"
        owner={name}
        path="sizing.curvature.edges_per_turn"
        step={1}
        value={size.edges_per_turn}
        onChange={(edges_per_turn) => set('Edges to a full turn', { edges_per_turn })}
      />
      <NumberField
        label="Smallest edge"
        owner={name}
        unit="mm"
        path="sizing.curvature.edge_min_mm"
        step={0.1}
        value={size.edge_min_mm}
        onChange={(edge_min_mm) => set('Smallest edge of curvature', { edge_min_mm })}
      />
    </>
  );
}
