import { useState } from 'preact/hooks';
import type { Report } from '../../engine/contract';
import { shownResult } from '../../store/run/results';
import { focusTet, stageShown } from '../../store/view';
import { SelectField } from '../controls/fields';
import { sentence, short, unitSign } from '../controls/format';
import { showView } from '../controls/page_shape';
import { colourOf, nameOf } from '../../store/case/legend/legend';

function flyTo(tet: number): void {
  if (stageShown.value !== 'optimise') stageShown.value = 'quality';
  focusTet.value = tet;
}

/** The elements that are worst by a measure; a click flies to one, and arrow keys go along the list. */
export function WorstList({ found }: { found: Report }) {
  const ranked = found.quality.metrics.filter(
    ({ elements, worst }) => elements === 'tets' && worst.length > 0,
  );
  const [name, setName] = useState('min_dihedral_deg');
  const metric = ranked.find((entry) => entry.name === name) ?? ranked[0];
  const labels = shownResult('optimise')?.labels;
  const values = shownResult('quality')?.values[metric?.name ?? name];
  if (!metric || !labels || !values) return null;
  const worst = metric.worst.slice(0, 50);
  // One stop of the Tab key: the element that is shown, or the worst.
  const stop = Math.max(0, worst.indexOf(focusTet.value ?? -1));
  const onKey = (event: KeyboardEvent & { currentTarget: HTMLElement }) => {
    const rows = [...event.currentTarget.querySelectorAll('button')];
    const now = rows.indexOf(document.activeElement as HTMLButtonElement);
    const next = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: rows.length - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    if (!rows[next]) return;
    rows[next].focus();
    flyTo(worst[next]);
  };
  return (
    <section class="section">
      <h2>Worst elements</h2>
      <SelectField
        label="By"
        value={metric.name}
        options={ranked.map((entry) => [entry.name, entry.title || sentence(entry.name)] as const)}
        onChange={(next) => setName(next)}
      />
      <ol class="worst" onKeyDown={onKey}>
        {worst.map((tet, rank) => (
          <li key={tet}>
            <button
              type="button"
              tabIndex={rank === stop ? 0 : -1}
              aria-current={focusTet.value === tet}
              aria-label={`Fly to element ${tet}, number ${rank + 1} from the worst: ${short(values[tet])} ${unitSign(metric.unit)}, ${nameOf(labels[tet])}`}
              onClick={() => {
                flyTo(tet);
                showView();
              }}
            >
              <span class="rank">{rank + 1}</span>
              <span class="worst-value">
                {short(values[tet])}
                {unitSign(metric.unit)}
              </span>
              <svg class="dot" viewBox="0 0 8 8" aria-hidden="true">
                <circle cx="4" cy="4" r="4" fill={colourOf.value(labels[tet])} />
              </svg>
              <span class="worst-label">{nameOf(labels[tet])}</span>
            </button>
          </li>
        ))}
      </ol>
    </section>
  );
}
