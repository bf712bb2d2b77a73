import type { Recipe } from '../../engine/contract';
import { editRecipe } from '../../store/case/recipe';
import { alignment } from '../../store/run/report';
import { previewSoon } from '../../store/run/run_stages';
import { schema } from '../../store/run/stages';
import { NumberField } from '../controls/fields';

function edit(label: string, change: (draft: Recipe) => void, key?: string) {
  editRecipe(label, change, key);
  previewSoon();
}

function applyPreset() {
  const preset = schema.value?.presets?.thick_stack;
  if (!preset) return;
  edit('Thick stack', (draft) => {
    Object.assign(draft.volume, preset.volume);
    Object.assign(draft.smooth, preset.smooth);
  });
}

/** The moves that the last run made become the recipe's own, to be edited. */
function MovesFound({ current }: { current: Recipe }) {
  const moves = alignment.value?.slices;
  if (!moves || current.volume.slice_shifts.length > 0) return null;
  const take = () =>
    edit('Moves of slices', (draft) => {
      draft.volume.slice_shifts = moves.map(({ slice, move_mm: [first_mm, second_mm] }) => ({
        slice,
        first_mm,
        second_mm,
      }));
    });
  return (
    <button type="button" class="button small" onClick={take}>
      Edit the moves found
    </button>
  );
}

function Moves({ current }: { current: Recipe }) {
  const { slice_shifts } = current.volume;
  if (slice_shifts.length === 0) return null;
  return (
    <details class="more" open>
      <summary>Moves of slices</summary>
      {slice_shifts.map(({ slice, ...move }, index) =>
        (['first_mm', 'second_mm'] as const).map((axis) => (
          <NumberField
            key={`${slice} ${axis}`}
            label={`Slice ${slice}, ${axis === 'first_mm' ? 'first' : 'second'} axis`}
            unit="mm"
            path={`volume.slice_shifts.${axis}`}
            step={0.5}
            value={move[axis]}
            onChange={(value) =>
              edit(
                `Move of slice ${slice}`,
                (draft) => void (draft.volume.slice_shifts[index][axis] = value),
                `slice ${slice} ${axis}`,
              )
            }
          />
        )),
      )}
      <button
        type="button"
        class="button small"
        onClick={() => edit('Moves of slices', (draft) => void (draft.volume.slice_shifts = []))}
      >
        Estimate them again
      </button>
    </details>
  );
}

/** What a clinical stack needs, on one click. */
export function StackSection({ current }: { current: Recipe }) {
  return (
    <section class="section">
      <div class="section-head">
        <h2>Thick slices</h2>
        <button
          type="button"
          class="button small"
          title="Puts shifted slices back, interpolates between slices, and smooths the steps between them away."
          onClick={applyPreset}
        >
          Thick stack
        </button>
      </div>
      <MovesFound current={current} />
      <Moves current={current} />
    </section>
  );
}
