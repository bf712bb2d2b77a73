/** What this is: its version, licence, source, how to cite it, and what happens to data. */
import { citation } from '../../report/citation';
import { schema } from '../../store/run/stages';
import { CopyButton } from '../controls/copy_button';
import { Dialog } from '../controls/dialog';

export function AboutDialog({ close }: { close(): void }) {
  const version = schema.value?.version ?? 'still starting';
  const text = citation(version);
  return (
    <Dialog title="About voxtet" onClose={close}>
      <dl class="offer">
        <div>
          <dt>Version</dt>
          <dd>
            <code>{version}</code>: engines of the same version make the same meshes, byte for byte
          </dd>
        </div>
        <div>
          <dt>Manual</dt>
          <dd>
            <a href="docs/" target="_blank" rel="noopener">
              Documentation
            </a>
            : each stage, every field of a case, formats, the command line
          </dd>
        </div>
        <div>
          <dt>Licence</dt>
          <dd>
            <a href="LICENSE.txt">GNU Affero General Public License</a>, version 3 or later.{' '}
            <a href="voxtet-source.tar.gz" download>
              Source of this page
            </a>
          </dd>
        </div>
        <div>
          <dt>Made with</dt>
          <dd>TetGen (AGPL), CGAL (GPL, LGPL), Eigen (MPL), three.js (MIT), Preact (MIT), uPlot (MIT)</dd>
        </div>
        <div>
          <dt>Privacy</dt>
          <dd>
            What you open stays on this machine: nothing is uploaded, and no other server is asked for
            anything.
          </dd>
        </div>
      </dl>
      <h3>How to cite</h3>
      <pre class="citation" tabIndex={0}>
        {text}
      </pre>
      <div class="dialog-actions">
        <CopyButton text={text}>Copy BibTeX</CopyButton>
      </div>
    </Dialog>
  );
}
