import type { ThicknessSize } from '../../../engine/contract';
import { robustRange } from '../../../geometry/faces';
import { editRecipe } from '../../../store/case/recipe';
import { sizingFields, thicknessRange } from '../../../store/run/sizing_fields';
import { CheckField, NumberField, Segments } from '../../controls/fields';
import { short } from '../../controls/format';
import { LabelChips } from '../../controls/label_chips';

/** Between which the middle 98 % of the thickness of all walls lies, mm. */
function usualRange(): [number, number] | null {
  const values = sizingFields()?.thickness?.values;
  return values ? robustRange(values, (voxel) => values[voxel] > 0) : null;
}

function RangeFields({ wall, name, set }: { wall: ThicknessSize; name: string; set: WallEdit }) {
  const measured = wall.thin_mm === 0 && wall.thick_mm === 0;
  const number = (
    label: string,
    key: 'edge_thin_mm' | 'edge_thick_mm' | 'thin_mm' | 'thick_mm',
    step: number,
  ) => (
    <NumberField
      label={label}
      owner={name}
      unit="mm"
      path={`sizing.thickness.${key}`}
      step={step}
      value={wall[key]}
      onChange={(value) => set(label, { [key]: value })}
    />
  );
  const settle = (own: boolean) => {
    const [lo, hi] = own ? (usualRange() ?? [3, 12]) : [0, 0];
    set('Range of thickness', { thin_mm: Number(lo.toPrecision(2)), thick_mm: Number(hi.toPrecision(2)) });
  };
  return (
    <>
      {number('Edge where thin', 'edge_thin_mm', 0.1)}
      {number('Edge where thick', 'edge_thick_mm', 0.1)}
      <CheckField
        label="Thin and thick as measured"
        hint="The first and the last percentile of the wall's thickness"
        checked={measured}
        onChange={(on) => settle(!on)}
      />
      {!measured && number('Thin is', 'thin_mm', 0.5)}
      {!measured && number('Thick is', 'thick_mm', 0.5)}
    </>
  );
}

type WallEdit = (label: string, change: Partial<ThicknessSize>) => void;

export function WallFields({ wall, index, name }: { wall: ThicknessSize; index: number; name: string }) {
  const set: WallEdit = (label, change) =>
    editRecipe(
      label,
      (draft) => void Object.assign(draft.sizing.thickness[index], change),
      `wall ${index} ${label}`,
    );
  const range = thicknessRange();
  return (
    <>
      <LabelChips
        legend="Wall"
        hint="Labels of the image that form the wall"
        chosen={wall.wall}
        taken={wall.inner}
        onChange={(labels) => labels.length > 0 && set('Labels of wall', { wall: labels })}
      />
      <LabelChips
        legend="Inside of it"
        hint="Labels on its inner side, such as blood pools. None: the cavities of the background."
        chosen={wall.inner}
        taken={wall.wall}
        onChange={(labels) => set('Labels inside of wall', { inner: labels })}
      />
      <Segments
        label="Size by"
        value={wall.layers > 0 ? 'layers' : 'thickness'}
        options={[
          ['thickness', 'Thickness', 'From one edge length where it is thin to another where it is thick'],
          ['layers', 'Layers', 'The thickness over a number of elements'],
        ]}
        onChange={(way) => set('Size of wall', { layers: way === 'layers' ? 3 : 0 })}
      />
      {wall.layers > 0 ? (
        <NumberField
          label="Elements across"
          owner={name}
          path="sizing.thickness.layers"
          step={1}
          value={wall.layers}
          onChange={(layers) => layers > 0 && set('Layers', { layers })}
        />
      ) : (
        <RangeFields wall={wall} name={name} set={set} />
      )}
      {wall.layers > 0 && (
        <CheckField
          label="Exactly so many"
          hint="Sheets across the wall as inner surfaces: so many layers everywhere, as far as voxels allow"
          checked={wall.layering === 'exact'}
          onChange={(exact) => set('Exact layers', { layering: exact ? 'exact' : 'size' })}
        />
      )}
      {range && (
        <p class="facts">
          Measured: {short(range[0])} to {short(range[1])} mm.
        </p>
      )}
    </>
  );
}
