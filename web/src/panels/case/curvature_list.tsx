import type { CurvatureSize, Recipe } from '../../engine/contract';
import { volume } from '../../store/case/input';
import { carriersOf } from '../../store/case/labels';
import { editRecipe } from '../../store/case/recipe';
import { NumberField } from '../controls/fields';
import { LabelChips } from '../controls/label_chips';
import { SizeList } from '../controls/size_list';
import { nameOf } from '../../store/case/legend/legend';

function newCurvature(current: Recipe): CurvatureSize {
  return {
    labels: [],
    edges_per_turn: 20,
    edge_min_mm: Number((current.sizing.edge_mm / 4).toPrecision(2)),
  };
}

/** Only the surfaces of regions of the mesh are there to bend. */
function unmeshed(current: Recipe): number[] {
  const all = volume.value?.labels.map(({ label }) => label) ?? [];
  const carriers = carriersOf(current.merge, current.labels.length > 0 ? current.labels : all);
  return all.filter((label) => !carriers.includes(label));
}

function CurvatureFields(props: { current: Recipe; size: CurvatureSize; index: number; name: string }) {
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

/** Surfaces that are sized by how sharply they bend. */
export function CurvatureList({ current }: { current: Recipe }) {
  return (
    <SizeList
      title="Bends"
      kind="Curvature"
      hint="Smaller elements where a surface bends sharply."
      of={({ sizing }) => sizing.curvature}
      current={current}
      fresh={newCurvature}
      nameOf={({ labels }) => (labels.length > 0 ? labels.map(nameOf).join(', ') : 'All surfaces')}
      noteOf={({ edges_per_turn }) => `${edges_per_turn} to a turn`}
      fields={(size, index, name) => (
        <CurvatureFields current={current} size={size} index={index} name={name} />
      )}
    />
  );
}
