/** Values that were found elsewhere at the points of the mesh that is shown: openCARP's .dat and .igb. */
import type { Frame } from '../../engine/contract';
import { announcement, tell } from '../notices';
import { colourBy, stageShown } from '../view';
import { engine, takeTurn, tellError } from './engine';
import { forgetFrames, keepFound, keepFrame, simulation } from './frames';
import { play } from './player';
import { meshedRecipe } from './report';
import { activity } from './stages';

/** The values of a .dat become a colour of the mesh, the frames of an .igb are played. */
export async function openValues(files: readonly File[]): Promise<void> {
  for (const file of files) await openOne(file);
}

async function openOne(file: File): Promise<void> {
  const current = meshedRecipe.value;
  if (!current) {
    const text = `${file.name} holds values at the points of a mesh: mesh the case first.`;
    return tell('error', 'There is no mesh yet', text);
  }
  if (activity.value !== 'idle') {
    return tell('error', 'The engine is at work', `Open ${file.name} again when it is done.`);
  }
  const newest = takeTurn();
  activity.value = 'run';
  announcement.value = `Reading ${file.name}`;
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (!newest()) return;
    const lives = /\.igb$/i.test(file.name);
    let count = 0;
    const keep = (frame: Frame) => {
      if (!newest()) return;
      // In place of the frames of a simulation.
      if (lives && count++ === 0) forgetFrames();
      (lives ? keepFrame : keepFound)(frame);
      colourBy.value = frame.fields[0].name;
    };
    const values = { name: file.name, bytes, siblings: {} };
    await engine.values(JSON.stringify(current), current.source, values, keep);
    if (!newest()) return;
    stageShown.value = 'quality';
    announcement.value = `${file.name} is shown`;
    if (!lives) return;
    simulation.value = 'done';
    play();
  } catch (error) {
    if (newest()) tellError(error);
  } finally {
    if (newest()) activity.value = 'idle';
  }
}
