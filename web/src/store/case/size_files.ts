/** A file that the user gives for element sizes. */
import type { FileSource, SideKind, VolumeFile } from '../../engine/contract';
import { engine, takeTurn, tellError } from '../run/engine';
import { restorePainting } from './painting';
import { editRecipe } from './recipe';
import { announcement } from '../notices';
import { activity, endStages } from '../run/stages';
import { awaitedSides, holdSide } from './side_files';

/** Reads a file as a mask or an image of sizes; the recipe asks for it from then on. */
export async function openSideFile(kind: SideKind, read: () => Promise<VolumeFile>): Promise<void> {
  const newest = takeTurn();
  activity.value = 'opening';
  try {
    const file = await read();
    announcement.value = `Reading ${file.name}`;
    if (!newest()) return;
    endStages();
    if (engine.busy) await engine.cancel();
    const awaited = awaitedSides.value.find((one) => one.kind === kind && one.name === file.name);
    const { digest, labels } = await engine.openSideVolume(kind, file, awaited?.sha256);
    holdSide({ kind, file, digest });
    if (!awaited) ask(kind, { name: file.name, sha256: digest }, labels);
    restorePainting();
    announcement.value = `${file.name} sets element sizes`;
  } catch (error) {
    tellError(error);
  } finally {
    if (newest()) activity.value = 'idle';
  }
}

function ask(kind: SideKind, file: FileSource, labels: readonly number[]): void {
  editRecipe(kind === 'mask' ? 'Add mask' : 'Add image of sizes', (draft) => {
    const { sizing } = draft;
    if (kind === 'image') {
      sizing.images = [...sizing.images.filter(({ name }) => name !== file.name), file];
      return;
    }
    const edge_mm = Number((sizing.edge_mm / 2).toPrecision(2));
    const edges = labels.map((label) => ({ label, edge_mm }));
    sizing.masks = [...sizing.masks.filter(({ name }) => name !== file.name), { ...file, edges }];
  });
}
