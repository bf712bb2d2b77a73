import type { CurvatureSize, Recipe } from '../../../engine/contract';
import { fetched } from '../../controls/fetched';
import { SizeList } from '../../controls/size_list';
import { nameOf } from '../../../store/case/legend/legend';

function newCurvature(current: Recipe): CurvatureSize {
  return {
    labels: [],
    edges_per_turn: 20,
    edge_min_mm: Number((current.sizing.edge_mm / 4).toPrecision(2)),
  };
}

/** Fields of the one that is open; few cases have one. */
const CurvatureFields = fetched(() => import('./curvature_fields').then((part) => part.CurvatureFields));

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
