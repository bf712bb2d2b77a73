import { volume } from '../../store/case/input';
import { nameOf } from '../../store/case/legend/legend';
import { Explain } from './explain';

/** Labels to choose from, as small switches. */
export function LabelChips(props: {
  legend: string;
  hint: string;
  chosen: readonly number[];
  /** Labels that are not to choose from. */
  taken: readonly number[];
  onChange(labels: number[]): void;
}) {
  const { legend, hint, chosen, taken } = props;
  const labels = volume.value?.labels.map(({ label }) => label) ?? [];
  return (
    <div class="label-choice">
      <fieldset class="label-chips" title={hint}>
        <legend>{legend}</legend>
        <div class="label-chip-row">
          {labels
            .filter((label) => !taken.includes(label))
            .map((label) => (
              <button
                type="button"
                key={label}
                class="label-chip"
                aria-pressed={chosen.includes(label)}
                onClick={() => {
                  const without = chosen.filter((one) => one !== label);
                  const next = without.length < chosen.length ? without : [...chosen, label];
                  props.onChange(next.sort((a, b) => a - b));
                }}
              >
                {nameOf(label)}
              </button>
            ))}
        </div>
      </fieldset>
      <Explain of={legend} text={hint} />
    </div>
  );
}
