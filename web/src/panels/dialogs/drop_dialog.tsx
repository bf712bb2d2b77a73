import { droppedFiles, openFiles, openSizeFiles } from '../../store/case/open_files';
import { Dialog } from '../controls/dialog';

/** What a file is for that was dropped on an open case. */
export function DropDialog() {
  const files = droppedFiles.value;
  if (!files) return null;
  const close = () => (droppedFiles.value = null);
  const isNifti = files.some(({ name }) => /\.nii(\.gz)?$/i.test(name));
  const ways: [string, string, () => Promise<void>][] = [
    ['Open it', 'Another volume to be meshed. The case that is open is closed.', () => openFiles(files)],
    ['Mask of sizes', 'An edge length for each of its labels.', () => openSizeFiles('mask', files)],
  ];
  if (isNifti)
    ways.push([
      'Image of sizes',
      'An edge length in mm at every voxel.',
      () => openSizeFiles('image', files),
    ]);
  return (
    <Dialog title={`What is ${files[0].name} for?`} onClose={close}>
      <div class="ways">
        {ways.map(([name, note, go]) => (
          <button
            key={name}
            type="button"
            class="way"
            onClick={() => {
              close();
              void go();
            }}
          >
            <strong>{name}</strong>
            <span>{note}</span>
          </button>
        ))}
      </div>
    </Dialog>
  );
}
