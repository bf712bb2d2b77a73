import type { Verdict } from '../../link/verdict';
import { stagesPromised } from '../../link/verdict';
import { expectation, report, verdict } from '../../store/run/report';
import { keptInUse } from '../../store/case/keep/kept_engines';
import { simulatePromised } from '../../store/run/simulate';
import { activity } from '../../store/run/stages';
import { CopyButton } from '../controls/copy_button';
import { whole } from '../controls/format';
import { Icon } from '../controls/icons';

const titles = {
  reproduced: 'Reproduced, byte for byte',
  differs: 'Differs from what the link promises',
  other_engine: 'Made with another engine',
};

/** Engines are told apart by their last characters too; of a digest the first are enough. */
const shown = (row: string, text: string) => (row.startsWith('Digest') ? `${text.slice(0, 10)}…` : text);

/** The worse of what the mesh and the simulation on it turned out to be. */
function worse({ mesh, simulation }: Verdict) {
  return mesh === 'reproduced' && simulation && simulation !== 'awaited' ? simulation : mesh;
}

function SimulationAwaited() {
  const promised = expectation.value?.expected;
  if (!promised) return null;
  return (
    <p>
      This is the mesh. The link promises what is simulated on it too.{' '}
      <button
        type="button"
        class="button small"
        disabled={activity.value !== 'idle'}
        onClick={() => void simulatePromised(stagesPromised(promised))}
      >
        <Icon name="play" size={13} /> Simulate it
      </button>
    </p>
  );
}

export function VerdictCard() {
  const found = verdict.value;
  const promise = expectation.value;
  if (!promise) return null;
  const kept = keptInUse.value !== null && (
    <p>
      The engine is voxtet {keptInUse.value.version}, kept here beside the page's own: the one that made this
      case.{' '}
      <a href={`${keptInUse.value.folder}voxtet-source.tar.gz`} download>
        Its source
      </a>
    </p>
  );
  if (!found) {
    return (
      <section class="verdict pending" role="status">
        <h2>This link promises a mesh</h2>
        <p>
          {whole(promise.expected.tets)} tetrahedra, made with voxtet {promise.expected.engine}.{' '}
          {report.value
            ? 'The settings were changed since; undo to compare.'
            : 'Run to see whether it is reproduced.'}
        </p>
        {kept}
      </section>
    );
  }
  const kind = worse(found);
  return (
    <section class={`verdict ${kind}`} role="status" data-testid="verdict">
      <h2>
        <Icon name={kind === 'reproduced' ? 'check' : 'warn'} /> {titles[kind]}
      </h2>
      {kind === 'other_engine' && (
        <p>
          The link was made with voxtet {promise.expected.engine}. Another version of the engine may make
          another mesh of the same case, and its physics another wave.
        </p>
      )}
      {kept}
      {found.simulation === 'awaited' && <SimulationAwaited />}
      <table>
        <thead>
          <tr>
            <th scope="col">
              <span class="sr">What</span>
            </th>
            <th scope="col">Link</th>
            <th scope="col">This run</th>
          </tr>
        </thead>
        <tbody>
          {found.rows.map((row) => (
            <tr key={row.name} class={row.same ? '' : 'other'}>
              <th scope="row">{row.name}</th>
              <td title={row.expected}>{shown(row.name, row.expected)}</td>
              <td title={row.found}>
                {shown(row.name, row.found)}
                {row.name.startsWith('Digest') && (
                  <CopyButton
                    class="icon-button small"
                    label={`Copy: ${row.name.toLowerCase()} of this run`}
                    text={row.found}
                  >
                    <Icon name="copy" size={14} />
                  </CopyButton>
                )}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
