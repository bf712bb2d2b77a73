import { checks, failure, groups, measuredText, seconds, start, state, summary } from './checks';

const run = () => start(new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' }));

/** What stands above the table while nothing, something or everything has been checked. */
function Standing() {
  if (state.value === 'failed') return <p class="bad">The checks stopped: {failure.value}</p>;
  if (state.value === 'running') return <p>Checking… {checks.value.length} so far</p>;
  if (state.value === 'idle') return <p>About a minute; nothing is sent anywhere.</p>;
  const all = checks.value.every(({ agrees }) => agrees);
  return (
    <p class={all ? 'good' : 'bad'}>
      <strong>{summary(checks.value)}</strong> with what is expected, in {seconds.value.toFixed(0)} s on this
      machine.
    </p>
  );
}

export function VerificationPage() {
  return (
    <main>
      <a href="./">voxtet</a>
      <h1>Verification of the physics</h1>
      <p>
        Fibres, activation maps, waves of excitation, active stress and circulation, computed in this page by
        the engine that the app uses, beside closed forms and what other codes give. Each line says what was
        measured here, what is expected, and where that comes from.
      </p>
      <button type="button" class="primary" disabled={state.value === 'running'} onClick={run}>
        {state.value === 'idle' ? 'Run the checks' : 'Run again'}
      </button>
      <div role="status">
        <Standing />
      </div>
      {groups.value.map(([title, found]) => (
        <section key={title}>
          <h2>{title}</h2>
          <table>
            <thead>
              <tr>
                <th scope="col">Case</th>
                <th scope="col">Measured</th>
                <th scope="col">Expected</th>
                <th scope="col">By</th>
                <th scope="col">Agrees</th>
              </tr>
            </thead>
            <tbody>
              {found.map((one) => (
                <tr key={one.case}>
                  <td>{one.case}</td>
                  <td class="number">{measuredText(one)}</td>
                  <td>{one.expected}</td>
                  <td class="soft">{one.source}</td>
                  <td class={one.agrees ? 'good' : 'bad'}>{one.agrees ? 'yes' : 'no'}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </section>
      ))}
    </main>
  );
}
