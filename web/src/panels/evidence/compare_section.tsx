import type { Report } from '../../engine/contract';
import { changedFields, differencesOf, type Difference } from '../../report/differences';
import { pinned, pinRun, unpin, type PinnedRun } from '../../store/run/compare';
import { simulatedPhysics } from '../../store/run/frames';
import { meshedRecipe } from '../../store/run/report';
import { shownKeys } from '../../store/run/results';
import { comparedFields } from '../../store/run/simulated_fields';
import { layout } from '../../store/view';
import { fetched } from '../controls/fetched';
import { short, whole } from '../controls/format';
import { Icon } from '../controls/icons';

/** Three decimals are enough for what is smaller than one. */
const brief = (value: number) => short(Math.abs(value) < 1 ? Number(value.toFixed(3)) : value);
const text = (value: number) => (Number.isInteger(value) ? whole(value) : brief(value));

function change({ pinned: before, now, unit, better }: Difference): { words: string; tone: string } {
  const step = now - before;
  if (Math.abs(step) < 1e-9 * Math.max(1, Math.abs(before))) return { words: '=', tone: '' };
  const share = unit === '' && Math.abs(before) > 1 ? (100 * step) / before : null;
  const size = share === null ? brief(Math.abs(step)) : `${Math.abs(share).toFixed(1)} %`;
  const good = better && (better === 'more') === step > 0;
  return { words: `${step > 0 ? '+' : '−'}${size}`, tone: better ? (good ? 'better' : 'worse') : '' };
}

function Differences({ run, found }: { run: PinnedRun; found: Report }) {
  return (
    <>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Differences of the two runs">
        <table class="measures tight" data-testid="differences">
          <thead>
            <tr>
              <th scope="col">Measure</th>
              {['Pinned', 'Now', 'Change'].map((name) => (
                <th key={name} scope="col" class="num">
                  {name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {differencesOf(run.report, found).map((row) => {
              const { words, tone } = change(row);
              return (
                <tr key={row.name}>
                  <th scope="row" title={row.name}>
                    {row.name} <span class="unit">{row.unit}</span>
                  </th>
                  <td class="num">{text(row.pinned)}</td>
                  <td class="num">{text(row.now)}</td>
                  <td class={`num ${tone}`}>{words}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </>
  );
}

/** What was asked of the two runs, where that differs. */
function Changes({ run }: { run: PinnedRun }) {
  const now = meshedRecipe.value;
  if (!now) return null;
  const [before, after] = [run.physics, simulatedPhysics.value].map((physics) => physics ?? undefined);
  const fields = changedFields({ ...run.recipe, physics: before }, { ...now, physics: after });
  if (fields.length === 0) return null;
  return (
    <dl class="changes">
      {fields.map(({ path, pinned: then, now: next }) => (
        <div key={path}>
          <dt>{path}</dt>
          <dd>
            {then} → {next}
          </dd>
        </div>
      ))}
    </dl>
  );
}

const SimulatedDifferences = fetched(() =>
  import('./simulated_differences').then((part) => part.SimulatedDifferences),
);

/** Two meshes have no points in common at which their simulations could be compared. */
function OtherMesh({ run }: { run: PinnedRun }) {
  if (!run.physics || !simulatedPhysics.value || run.mesh === shownKeys.value.optimise) return null;
  return (
    <p class="hint">
      The pinned simulation is on another mesh: activation is compared on the same mesh only.
    </p>
  );
}

/** A run is pinned; the next ones stand beside it. */
export function CompareSection({ found }: { found: Report }) {
  const run = pinned.value;
  const simulated = comparedFields.value.length > 0;
  const same = run?.report === found && !simulated;
  return (
    <section class="section compare">
      <h2>Compare</h2>
      {!run && (
        <p class="hint">Pin this run, change something, run or simulate again: both stand side by side.</p>
      )}
      {same && <p class="hint">This run is pinned. Change something and run or simulate again to compare.</p>}
      <div class="compare-actions">
        {!same && (
          <button type="button" class="button small" onClick={pinRun}>
            <Icon name="pin" size={13} /> {run ? 'Pin this run instead' : 'Pin this run'}
          </button>
        )}
        {run && (
          <button type="button" class="button small" onClick={unpin}>
            Unpin
          </button>
        )}
        {run && !same && layout.value !== 'compare' && (
          <button type="button" class="button small" onClick={() => (layout.value = 'compare')}>
            Side by side
          </button>
        )}
      </div>
      {run && simulated && <SimulatedDifferences />}
      {run && run.report !== found && <Differences run={run} found={found} />}
      {run && !same && <Changes run={run} />}
      {run && <OtherMesh run={run} />}
    </section>
  );
}
