import { focusTet, picked, type Picked } from '../../store/view';
import { Icon } from '../controls/icons';

/** The numbers of an element, in the half of the view where it is not. */
export function PickedCard({ found }: { found: Picked }) {
  return (
    <div class={`picked ${found.side === 'left' ? 'right' : 'left'}`} role="status">
      <div class="picked-head">
        <strong>{found.title}</strong>
        <button
          type="button"
          class="icon-button small"
          aria-label="Close"
          onClick={() => {
            picked.value = null;
            focusTet.value = null;
          }}
        >
          <Icon name="cross" size={13} />
        </button>
      </div>
      <dl>
        {found.lines.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}
