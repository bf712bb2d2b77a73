import type { Vec3 } from '../../engine/contract';
import { command, cut } from '../../store/view';
import { Segments, Slider } from '../controls/fields';

const cutAxes: [string, string, Vec3][] = [
  ['R', 'Cut from right to left', [1, 0, 0]],
  ['A', 'Cut from front to back', [0, 1, 0]],
  ['S', 'Cut from head to feet', [0, 0, 1]],
];

function CutDirection() {
  const { normal } = cut.value;
  const axis = cutAxes.find(
    ([, , direction]) =>
      direction.every((part, i) => part === normal[i]) || direction.every((part, i) => -part === normal[i]),
  );
  return (
    <div class="segments" role="group" aria-label="Direction of the cut">
      {cutAxes.map(([name, title, direction]) => (
        <button
          type="button"
          key={name}
          title={title}
          aria-label={title}
          aria-pressed={axis?.[0] === name}
          onClick={() => (cut.value = { ...cut.value, normal: direction })}
        >
          {name}
        </button>
      ))}
      <button
        type="button"
        title="Cut facing me"
        aria-pressed={!axis}
        onClick={() => (command.value = { kind: 'cut_facing_me' })}
      >
        View
      </button>
    </div>
  );
}

/** Where the cut is, and what it leaves. */
export function CutFields({ onTets }: { onTets: boolean }) {
  const { flat, normal, place } = cut.value;
  return (
    <div class="cut-tools">
      {onTets && (
        <Segments
          label="What the cut leaves"
          value={flat ? 'flat' : 'whole'}
          options={[
            ['whole', 'Whole', 'Tetrahedra stay whole'],
            ['flat', 'Flat', 'The plane goes through tetrahedra'],
          ]}
          onChange={(kind) => (cut.value = { ...cut.value, flat: kind === 'flat' })}
        />
      )}
      <CutDirection />
      <Slider
        name="Place of the cut"
        value={place}
        onValue={(next) => (cut.value = { ...cut.value, place: next })}
      />
      <button
        type="button"
        class="tool"
        title="Keep the other side"
        onClick={() =>
          (cut.value = {
            ...cut.value,
            normal: normal.map((part) => -part || 0) as Vec3,
            place: 1 - place,
          })
        }
      >
        Flip
      </button>
    </div>
  );
}
