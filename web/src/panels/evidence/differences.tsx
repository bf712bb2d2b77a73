import type { Report } from '../../engine/contract';
import { changedFields, differencesOf, type Difference } from '../../report/differences';
import type { PinnedRun } from '../../store/run/compare';
import { simulatedPhysics } from '../../store/run/frames';
import { meshedRecipe } from '../../store/run/report';
import { shownKeys } from '../../store/run/results';
import { comparedFields, differenceFound } from '../../store/run/simulated_fields';
import { colourBy } from '../../store/view';
import { pathWords } from '../controls/field_words';
import { short, whole } from '../controls/format';

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

/** The head of a table of numbers, behind a column of names. */
function NumberHeads({ first, columns }: { first: string; columns: readonly string[] }) {
  return (
    <thead>
      <tr>
        <th scope="col">{first}</th>
        {columns.map((name) => (
          <th key={name} scope="col" class="num">
            {name}
          </th>
        ))}
      </tr>
    </thead>
  );
}

function MeshDifferences({ run, found }: { run: PinnedRun; found: Report }) {
  return (
    <div class="table-scroll" tabIndex={0} role="region" aria-label="Differences of the two runs">
      <table class="measures tight" data-testid="differences">
        <NumberHeads first="Measure" columns={['Pinned', 'Now', 'Change']} />
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
      {fields.map(({ path, pinned: then, now: next }) => {
        const { name, unit } = pathWords(path);
        return (
          <div key={path} title={path}>
            <dt>{name}</dt>
            <dd>
              {then} → {next}
              {unit}
            </dd>
          </div>
        );
      })}
    </dl>
  );
}

/** Two meshes have no points in common at which their simulations could be compared. */
function OtherMesh({ run }: { run: PinnedRun }) {
  if (!run.physics || !simulatedPhysics.value || run.mesh === shownKeys.value.optimise) return null;
  return (
    <p class="hint">
      The pinned simulation is on another mesh: activation is compared on the same mesh only.
    </p>
  );
}

const digits = (value: number): string => short(Number(value.toPrecision(3)));

/** How far this simulation is from the pinned one, field by field; a click colours the mesh by it. */
function SimulatedDifferences() {
  const rows = comparedFields.value.flatMap(({ info, played }) => {
    const found = played ? undefined : differenceFound(info.name);
    return found ? [{ info, found }] : [];
  });
  if (rows.length === 0) return null;
  const one = Math.max(...rows.map(({ found }) => found.one));
  return (
    <>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Differences of the two simulations">
        <table class="measures tight" data-testid="simulated-differences">
          <NumberHeads first="This run less the pinned one" columns={['Mean', 'Rms', 'Largest']} />
          <tbody>
            {rows.map(({ info, found }) => (
              <tr key={info.name}>
                <th scope="row">
                  <button
                    type="button"
                    class="link-button"
                    title="Colours the mesh by it"
                    onClick={() => (colourBy.value = `difference_${info.name}`)}
                  >
                    {info.title}
                  </button>{' '}
                  <span class="unit">{info.unit}</span>
                </th>
                <td class="num">{digits(found.mean)}</td>
                <td class="num">{digits(found.rms)}</td>
                <td class="num">{digits(found.largest)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {one > 0 && <p class="hint">Up to {whole(one)} points have a value in one of the runs only.</p>}
    </>
  );
}

/** What has changed between two runs: meshes, what was simulated on one mesh, and what was asked for. */
export function Differences({ run, found }: { run: PinnedRun; found: Report }) {
  return (
    <>
      <SimulatedDifferences />
      {run.report !== found && <MeshDifferences run={run} found={found} />}
      <Changes run={run} />
      <OtherMesh run={run} />
    </>
  );
}
