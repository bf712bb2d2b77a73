import { useState } from 'preact/hooks';
import type { MaskSize, Recipe, SideKind } from '../../../engine/contract';
import { openSizeFiles } from '../../../store/case/open_files';
import { paintedName } from '../../../store/case/painting';
import { editRecipe } from '../../../store/case/recipe';
import { awaitedSides } from '../../../store/case/side_files';
import { NumberField } from '../../controls/fields';
import { FileInput } from '../../controls/file_input';
import { FoldedItem } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';

function SizeFileButton({ kind, label, title }: { kind: SideKind; label: string; title: string }) {
  return (
    <FileInput
      class="button small"
      title={title}
      testId={`${kind}-input`}
      onFiles={(files) => void openSizeFiles(kind, files)}
    >
      <Icon name="plus" size={13} /> {label}
    </FileInput>
  );
}

function MaskFields({ mask, index }: { mask: MaskSize; index: number }) {
  return (
    <>
      {mask.edges.map(({ label, edge_mm }, at) => (
        <NumberField
          key={label}
          label={`Edge in label ${label}`}
          owner={mask.name}
          unit="mm"
          path="sizing.masks.edges.edge_mm"
          step={0.1}
          value={edge_mm}
          onChange={(value) =>
            editRecipe(
              'Edge length of mask',
              (draft) => void (draft.sizing.masks[index].edges[at].edge_mm = value),
              `mask ${index} ${label}`,
            )
          }
        />
      ))}
    </>
  );
}

/** Masks and images of sizes in files of their own, and those that have to be dropped in again. */
export function SizeFiles({ current }: { current: Recipe }) {
  const [shown, setShown] = useState<string | null>(null);
  const { masks, images } = current.sizing;
  const waits = new Set(awaitedSides.value.map(({ kind, name }) => `${kind} ${name}`));
  const noteOf = (kind: SideKind, name: string, note: string) =>
    waits.has(`${kind} ${name}`) ? 'drop it in again' : note;
  const toggle = (key: string) => setShown(shown === key ? null : key);
  return (
    <div class="regions">
      <div class="regions-head">
        <h3>From files</h3>
        <span>
          <SizeFileButton
            kind="mask"
            label="Mask…"
            title="A label volume, with an edge length for each label"
          />
          <SizeFileButton kind="image" label="Image…" title="A NIfTI image of edge lengths in mm" />
        </span>
      </div>
      {masks.length + images.length === 0 && (
        <p class="hint">Edge lengths from a mask of labels, or from an image of millimetres.</p>
      )}
      {masks.map((mask, index) =>
        mask.name === paintedName && !waits.has(`mask ${paintedName}`) ? null : (
          <FoldedItem
            key={`mask ${mask.name}`}
            name={mask.name}
            note={noteOf('mask', mask.name, mask.edges.map(({ edge_mm }) => edge_mm).join(', ') + ' mm')}
            open={shown === `mask ${mask.name}`}
            onToggle={() => toggle(`mask ${mask.name}`)}
            onRemove={() => editRecipe('Remove mask', (draft) => void draft.sizing.masks.splice(index, 1))}
          >
            <MaskFields mask={mask} index={index} />
          </FoldedItem>
        ),
      )}
      {images.map(({ name }, index) => (
        <FoldedItem
          key={`image ${name}`}
          name={name}
          note={noteOf('image', name, 'mm at every voxel')}
          open={shown === `image ${name}`}
          onToggle={() => toggle(`image ${name}`)}
          onRemove={() =>
            editRecipe('Remove image of sizes', (draft) => void draft.sizing.images.splice(index, 1))
          }
        >
          <p class="facts">Edge lengths where the image has one; elsewhere the other sizes stand.</p>
        </FoldedItem>
      ))}
    </div>
  );
}
