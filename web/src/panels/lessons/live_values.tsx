import type { ValueRef } from '../../lessons/lesson';
import { titleOf, unitOf } from '../../lessons/checks';
import { readValue, type Found } from '../../lessons/values';
import { short } from '../controls/format';

export function foundText(found: Found, unit: string): string {
  if (found === null) return '–';
  return typeof found === 'string' ? found : `${short(found)}${unit === '°' ? unit : unit && ` ${unit}`}`;
}

/** Numbers of the app as they are now. */
export function LiveValues({ refs }: { refs: readonly ValueRef[] }) {
  return (
    <dl class="findings">
      {refs.map((ref, i) => (
        <div key={i}>
          <dt>{titleOf(ref)}</dt>
          <dd>{foundText(readValue(ref), unitOf(ref))}</dd>
        </div>
      ))}
    </dl>
  );
}
