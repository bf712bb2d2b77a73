/** What this is: its version, licence, source, how to cite it, and what happens to data. */
import { schema } from '../../store/run/stages';
import { CopyButton } from '../controls/copy_button';
import { Dialog } from '../controls/dialog';

const paper = `@inproceedings{lamecker2009adaptive,
  title     = {Adaptive Tetrahedral Meshing for Personalized Cardiac Simulations},
  author    = {Lamecker, Hans and Mansi, Tommaso and Relan, Jatin and Billet, Florence and
               Sermesant, Maxime and Ayache, Nicholas and Delingette, Herv{\\'e}},
  booktitle = {CI2BM09: MICCAI Workshop on Cardiovascular Interventional Imaging and
               Biophysical Modelling},
  year      = {2009}
}`;

/** BibTeX of this version, and of the article whose method it follows. */
export function citation(version: string): string {
  return `@software{voxtet,
  title   = {voxtet: adaptive tetrahedral meshes from segmented volumes},
  author  = {{voxtet contributors}},
  version = {${version}},
  license = {AGPL-3.0-or-later}
}

${paper}
`;
}

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
