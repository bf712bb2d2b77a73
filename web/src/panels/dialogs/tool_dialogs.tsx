/** Dialogs that are opened by hand; they are loaded when the first of them is. */
import { useState } from 'preact/hooks';
import {
  caseFormats,
  meshFormats,
  secondOrderFormats,
  type ExportFormat,
  type Space,
} from '../../engine/contract';
import { downloadReport, exportMesh, exportZip } from '../../store/case/exchange';
import { unread } from '../../store/case/open_files';
import { simulated } from '../../store/run/frames';
import { meshedRecipe, upToDate } from '../../store/run/report';
import { activity } from '../../store/run/stages';
import { Dialog } from '../controls/dialog';
import { dialogShown } from '../controls/dialog_shown';
import { fetched } from '../controls/fetched';
import { CheckField, Segments } from '../controls/fields';
import { Gallery } from '../case/gallery';
import { Icon } from '../controls/icons';
import { LessonList } from '../lessons/lesson_list';
import { KeyList } from '../view/key_list';
import { SizesDialog } from '../run/sizes_dialog';
import { AboutDialog } from './about_dialog';
import { GlossaryDialog } from './glossary_dialog';
import { MemoryDialog } from './memory_dialog';
import { ReadingDialog } from './reading_dialog';
import { ReviewDialog } from './review_dialog';
import { ShareDialog } from './share_dialog';

const SheetDialog = fetched(() => import('../lessons/sheet_dialog').then((part) => part.SheetDialog));

const formatNotes: Record<ExportFormat, [string, string]> = {
  vtu: ['VTU', 'ParaView, PyVista: tetrahedra and labels, mm'],
  vtk: ['Legacy VTK', '.vtk as text, for programs and scripts that know no VTU, mm'],
  xdmf: ['XDMF', 'FEniCS, ParaView; .xdmf, .h5, and the same of tagged facets, mm'],
  msh: ['Gmsh MSH 4.1', 'Gmsh, FEniCS; labels and interfaces named, mm'],
  msh22: ['Gmsh MSH 2.2', 'As text, for programs that know no later one; named, mm'],
  medit: ['Medit', 'MMG, FreeFEM; mm'],
  carp: ['openCARP', '.pts, .elem, .lon; a whole case after a simulation; µm'],
  inp: ['Abaqus', 'Abaqus, CalculiX; labels and interfaces named, mm'],
  bdf: ['Nastran', '.bdf: CTETRA, PSOLID by label, surfaces as loads, mm'],
  feb: ['FEBio', 'FEBio Studio; parts and interfaces named, mm'],
  tetgen: ['TetGen', '.node, .ele with labels, .face with markers, mm'],
  stl: ['STL', 'Boundary surface, for printing and viewing, mm'],
  label_stl: ['STL by label', 'The closed boundary of each label, in one zip, mm'],
  ply: ['PLY', 'Boundary surface with labels, mm'],
  feb_case: ['FEBio case', 'Passive inflation: fibres, material, pressure, base held; mm, kPa'],
  svmultiphysics: ['svMultiPhysics case', 'Passive inflation: solver.xml, VTU, faces, fibres; mm, kPa'],
};

function ExportDialog({ close }: { close(): void }) {
  const [format, setFormat] = useState<ExportFormat>('vtu');
  const [space, setSpace] = useState<Space>('ras');
  const [curved, setCurved] = useState(false);
  const order = curved && secondOrderFormats.includes(format) ? 2 : 1;
  const cases = meshedRecipe.value?.physics?.fibres ? caseFormats : [];
  return (
    <Dialog title="Export the mesh" onClose={close}>
      <div class="formats" role="radiogroup" aria-label="Format">
        {[...meshFormats, ...cases].map((name) => (
          <label key={name} class={format === name ? 'format chosen' : 'format'}>
            <input
              type="radio"
              name="format"
              value={name}
              checked={format === name}
              onChange={() => setFormat(name)}
            />
            <span class="format-name">{formatNotes[name][0]}</span>
            <span class="format-note">{formatNotes[name][1]}</span>
          </label>
        ))}
      </div>
      <div class="dialog-row">
        <span>Coordinates</span>
        <Segments
          label="Coordinates"
          value={space}
          options={[
            ['ras' as Space, 'RAS', 'Right, anterior, superior: NIfTI, 3D Slicer on screen'],
            ['lps' as Space, 'LPS', 'Left, posterior, superior: DICOM, ITK'],
          ]}
          onChange={(next: Space) => setSpace(next)}
        />
        <span class="muted">
          {space === 'ras' ? 'x to the right, as in NIfTI' : 'x to the left, as in DICOM'}
        </span>
      </div>
      {secondOrderFormats.includes(format) && (
        <CheckField
          label="Second order"
          hint="Tetrahedra of ten nodes; those of the boundary lie on the smoothed label surface"
          checked={curved}
          onChange={setCurved}
        />
      )}
      {format === 'carp' && (
        <p class="stale">
          {Object.keys(simulated.value).length > 0
            ? `The simulation goes along as a case that runs in openCARP: parameters (.par), stimulated points
              (.vtx) and the activation to be expected.`
            : `openCARP requires a .lon file with a direction for each element. It is written where the case has
              fibres; simulate here first to get a whole case.`}
        </p>
      )}
      {!upToDate.value && (
        <p class="stale">The recipe has changed since; this exports the mesh that is shown.</p>
      )}
      <div class="dialog-actions">
        <button type="button" class="button" onClick={() => downloadReport()}>
          Report (JSON)
        </button>
        <button
          type="button"
          class="button"
          title="The mesh with its report, the case and the masks of sizes, described as a research object (RO-Crate)"
          disabled={!upToDate.value}
          onClick={() => {
            close();
            void exportZip(format, space, order);
          }}
        >
          All in one zip
        </button>
        <button
          type="button"
          class="button primary"
          disabled={activity.value === 'export'}
          onClick={() => {
            close();
            void exportMesh(format, space, order);
          }}
        >
          <Icon name="download" /> Export
        </button>
      </div>
    </Dialog>
  );
}

export function ToolDialogs() {
  const close = () => {
    dialogShown.value = null;
    unread.value = null;
  };
  switch (unread.value ? 'reading' : dialogShown.value) {
    case 'reading':
      return <ReadingDialog close={close} />;
    case 'export':
      return <ExportDialog close={close} />;
    case 'share':
      return <ShareDialog close={close} />;
    case 'sizes':
      return <SizesDialog close={close} />;
    case 'memory':
      return <MemoryDialog close={close} />;
    case 'review':
      return <ReviewDialog close={close} />;
    case 'glossary':
      return <GlossaryDialog close={close} />;
    case 'about':
      return <AboutDialog close={close} />;
    case 'examples':
      return (
        <Dialog title="Examples" onClose={close}>
          <Gallery onOpen={close} />
          <h3>Lessons</h3>
          <LessonList onOpen={close} />
        </Dialog>
      );
    case 'lessons':
      return (
        <Dialog title="Lessons" onClose={close}>
          <LessonList onOpen={close} />
        </Dialog>
      );
    case 'sheet':
      return <SheetDialog close={close} />;
    case 'keys':
      return (
        <Dialog title="Keys" onClose={close}>
          <KeyList />
        </Dialog>
      );
    default:
      return null;
  }
}
