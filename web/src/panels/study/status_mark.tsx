import type { Status } from '../../store/study/read_study';
import { Icon } from '../controls/icons';

const icons = { done: 'check', failed: 'cross', missing: 'clock' } as const;

/** What came of a case, told by sign and word as well as by colour. */
export function StatusMark({ status }: { status: Status }) {
  return (
    <span class={`study-status ${status}`}>
      <Icon name={icons[status]} size={13} /> {status}
    </span>
  );
}
