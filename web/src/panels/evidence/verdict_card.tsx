import { expectation, report, verdict } from '../../store/run/report';
import { CopyButton } from '../controls/copy_button';
import { whole } from '../controls/format';
import { Icon } from '../controls/icons';

const titles = {
  reproduced: 'Reproduced, byte for byte',
  differs: 'Differs from what the link promises',
  other_engine: 'Made with another engine',
};

/** Engines are told apart by their last characters too; of a digest the first are enough. */
const shown = (row: string, text: string) => (row === 'Digest' ? `${text.slice(0, 10)}…` : text);

export function VerdictCard() {
  const found = verdict.value;
  const promise = expectation.value;
  if (!promise) return null;
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
      </section>
    );
  }
  return (
    <section class={`verdict ${found.kind}`} role="status" data-testid="verdict">
      <h2>
        <Icon name={found.kind === 'reproduced' ? 'check' : 'warn'} /> {titles[found.kind]}
      </h2>
      {found.kind === 'other_engine' && (
        <p>
          The link was made with voxtet {promise.expected.engine}. Another version of the engine may make
          another mesh of the same case.
        </p>
      )}
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
                {row.name === 'Digest' && (
                  <CopyButton class="icon-button small" label="Copy the digest of this run" text={row.found}>
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
