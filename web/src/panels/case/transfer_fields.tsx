import type { Recipe } from '../../engine/contract';
import { volume } from '../../store/case/input';
import { editRecipe } from '../../store/case/recipe';
import { CheckField, NumberField } from '../controls/fields';
import { nameOf } from '../../store/case/legend/legend';

/** Labels that become values of the tetrahedra instead of regions of the mesh. */
export function TransferFields({ current }: { current: Recipe }) {
  const { labels } = current.transfer;
  const toggle = (label: number) =>
    editRecipe('Transfer label', (draft) => {
      const others = labels.filter((one) => one !== label);
      draft.transfer.labels =
        others.length < labels.length ? others : [...others, label].sort((a, b) => a - b);
    });
  const samples = (text: string, key: 'samples_min' | 'samples_max') => (
    <NumberField
      label={text}
      path={`transfer.${key}`}
      value={current.transfer[key]}
      onChange={(value) => editRecipe(text, (draft) => void (draft.transfer[key] = value), key)}
    />
  );
  return (
    <details class="more">
      <summary>Label transfer{labels.length > 0 && <span class="tag">{labels.length}</span>}</summary>
      <p class="facts">
        Every tetrahedron is told what share of it these labels have, whether the mesh follows their boundary
        or not.
      </p>
      <div class="label-scroll">
        {volume.value?.labels.map(({ label }) => (
          <CheckField
            key={label}
            label={`Transfer ${nameOf(label)}`}
            checked={labels.includes(label)}
            onChange={() => toggle(label)}
          />
        ))}
      </div>
      {labels.length > 0 && samples('Samples, at least', 'samples_min')}
      {labels.length > 0 && samples('Samples, at most', 'samples_max')}
    </details>
  );
}
