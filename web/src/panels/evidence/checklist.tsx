import type { ChecklistItem, Report } from '../../engine/contract';
import { sentence } from '../controls/format';
import { Icon } from '../controls/icons';

const inSigns = (text: string) => text.replace(/ deg\b/g, '°').replaceAll('>= ', '≥ ');

/** What is wanted is said of what is not there, and where it is a limit that the figure can be held against. */
const saysMore = ({ passed, expected }: ChecklistItem) => !passed || /\d/.test(expected);

function CheckRow({ item }: { item: ChecklistItem }) {
  const tone = item.passed ? 'pass' : item.hard ? 'fail' : 'caution';
  return (
    <li class={tone}>
      <Icon name={item.passed ? 'check' : item.hard ? 'cross' : 'warn'} size={14} />
      <span class="check-name">{sentence(item.name)}</span>
      <span class="check-found">
        {inSigns(item.found)}
        {saysMore(item) && <span class="check-expected">, wanted {inSigns(item.expected)}</span>}
      </span>
      <span class="sr">{item.passed ? 'passed' : 'not passed'}</span>
    </li>
  );
}

export function Checklist({ found }: { found: Report }) {
  const { checklist } = found.quality;
  const failed = checklist.filter((item) => !item.passed).length;
  const rows = (passed: boolean) =>
    checklist
      .filter((item) => item.passed === passed)
      .map((item) => <CheckRow key={item.name} item={item} />);
  return (
    <section class="section">
      <h2>
        Checklist{' '}
        <span class={failed === 0 ? 'tag pass' : found.quality.passed ? 'tag caution' : 'tag fail'}>
          {failed === 0 ? 'all passed' : `${failed} of ${checklist.length} not passed`}
        </span>
      </h2>
      <ul class="checklist">{rows(false)}</ul>
      {failed < checklist.length && (
        <details class="more">
          <summary>{checklist.length - failed} passed</summary>
          <ul class="checklist">{rows(true)}</ul>
        </details>
      )}
    </section>
  );
}
