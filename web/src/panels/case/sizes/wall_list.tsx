import type { Recipe, ThicknessSize } from '../../../engine/contract';
import { volume } from '../../../store/case/input';
import { fetched } from '../../controls/fetched';
import { SizeList } from '../../controls/size_list';
import { nameOf } from '../../../store/case/legend/legend';
import { likelyWall } from '../../../store/case/legend/proposals';

function newWall(current: Recipe): ThicknessSize {
  const { edge_mm } = current.sizing;
  return {
    ...likelyWall(
      volume.value ?? { labels: [] },
      current.labels,
      current.sizing.thickness.flatMap(({ inner }) => inner),
    ),
    layers: 0,
    layering: 'size',
    edge_thin_mm: Number((edge_mm / 2).toPrecision(2)),
    edge_thick_mm: edge_mm,
    thin_mm: 0,
    thick_mm: 0,
  };
}

/** Fields of the wall that is open; few cases have one. */
const WallFields = fetched(() => import('./wall_fields').then((part) => part.WallFields));

/** Walls that are sized by their thickness. */
export function WallList({ current }: { current: Recipe }) {
  return (
    <SizeList
      title="Walls"
      kind="Wall"
      hint="Labels that form a wall, sized by how thick it is."
      of={({ sizing }) => sizing.thickness}
      current={current}
      fresh={newWall}
      nameOf={({ wall }) => wall.map(nameOf).join(', ')}
      noteOf={({ layers, edge_thin_mm, edge_thick_mm }) =>
        layers > 0
          ? `${layers} ${layers === 1 ? 'layer' : 'layers'}`
          : `${edge_thin_mm} to ${edge_thick_mm} mm`
      }
      fields={(wall, index, name) => <WallFields wall={wall} index={index} name={name} />}
    />
  );
}
