import { awaitedFile } from '../../store/case/input';
import { dialogShown } from '../controls/dialog_shown';
import { Gallery } from './gallery';
import { FileButton } from './source_section';

export function EmptyState() {
  const awaited = awaitedFile.value;
  return (
    <div class="empty">
      <svg class="empty-mark" viewBox="0 0 96 84" width="96" height="84" aria-hidden="true">
        <path d="M48 4 90 76 6 76Z M48 4 58 54 90 76 M58 54 6 76" />
      </svg>
      {awaited ? (
        <>
          <h1>Drop {awaited.name}</h1>
          <p>
            The link holds the settings; the volume stays with whoever has it. Its digest says whether it is
            the one.
          </p>
          <div class="empty-actions">
            <FileButton label="Open that file…" primary />
          </div>
        </>
      ) : (
        <>
          <h1>From a segmented volume to a tetrahedral mesh</h1>
          <p>
            Drop a label volume here: NIfTI, NRRD, MetaImage or a DICOM segmentation object. Or a mesh: VTU,
            Gmsh, MEDIT or openCARP. It is read and meshed in this tab; nothing is uploaded.
          </p>
          <div class="empty-actions">
            <FileButton label="Open a file…" primary />
          </div>
          <p class="empty-or">
            or begin with an example, or{' '}
            <button type="button" class="link-button" onClick={() => (dialogShown.value = 'lessons')}>
              take a lesson
            </button>
          </p>
          <Gallery />
          <p class="empty-or">
            <a href="docs/" target="_blank" rel="noopener">
              Documentation
            </a>
          </p>
        </>
      )}
    </div>
  );
}
