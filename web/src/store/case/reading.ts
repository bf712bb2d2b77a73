/** The file of a case, or one that could not be read, read again in another way. */
import type { Recipe, VolumeFile } from '../../engine/contract';
import { announcement } from '../notices';
import { engine, takeTurn, tellError } from '../run/engine';
import { preview } from '../run/run_stages';
import { activity, endStages } from '../run/stages';
import { fileRead, volume } from './input';
import { takeVolume } from './open_case';
import { editRecipe, recipe } from './recipe';

/** How a file is read: the part of a recipe's source that a file leaves open. */
export type Reading = Pick<Recipe['source'], 'unit' | 'background' | 'frame' | 'precedence' | 'threshold'>;

export const readingOf = ({ unit, background, frame, precedence, threshold }: Recipe['source']): Reading => ({
  unit,
  background,
  frame,
  precedence,
  threshold,
});

/** Segments that the engine names where some overlap: those of the volume, and those that lost all their voxels. */
export function overlapping(labels: readonly { label: number; name: string }[], warnings: readonly string[]) {
  const said = warnings.filter((text) => /overlap in|SEGMENT LOST/.test(text));
  if (said.length === 0) return [];
  const lost = said.flatMap((text) =>
    [...text.matchAll(/SEGMENT LOST: segment (?:(.+?) \(label \d+\)|label (\d+)) loses/g)].map(
      ([, name, label]) => name ?? label,
    ),
  );
  const present = labels.map(({ label, name }) => name || String(label));
  return [...lost, ...present.filter((name) => !lost.includes(name))];
}

/** Reads the file of the case in another way: one step of its history. False where it could not be read. */
async function readCase(reading: Reading): Promise<boolean> {
  const source = recipe.value?.source;
  const file = source?.file && engine.files.volume(source.file.sha256);
  if (!source || !file) return false;
  const summary = await engine.openVolume(file, { ...source, ...reading });
  editRecipe('How the file is read', (draft) => {
    Object.assign(draft.source, reading, {
      file: { ...source.file, name: file.name, sha256: summary.digest },
    });
  });
  volume.value = summary;
  void preview(true);
  return true;
}

/** Begins a case with a file that could not be read by itself, else reads that of the case again. */
export async function readAgain(reading: Reading, unread: VolumeFile | null): Promise<boolean> {
  const newest = takeTurn();
  fileRead.value = unread?.name ?? recipe.value?.source.file?.name ?? '';
  activity.value = 'opening';
  announcement.value = 'Reading the file again';
  try {
    endStages();
    if (engine.busy) await engine.cancel();
    if (!unread) return await readCase(reading);
    const summary = await engine.openVolume(unread, reading);
    if (newest()) takeVolume(summary, unread.name, reading);
    return true;
  } catch (error) {
    tellError(error);
    return false;
  } finally {
    if (newest() && activity.value === 'opening') activity.value = 'idle';
  }
}
