/** What the view says while there is not yet anything to see. */
import { fileRead, meshIsGiven, volume } from '../../store/case/input';
import { recipe } from '../../store/case/recipe';
import { pointsOf, shownKeys } from '../../store/run/results';
import { activity, stages } from '../../store/run/stages';
import { stageShown } from '../../store/view';

const isBusy = () => activity.value === 'preview' || activity.value === 'run';

/** What is being read or generated; nothing while the volume is not what is waited for. */
function whatComes(): string | null {
  if (activity.value === 'opening') return `Reading ${fileRead.value}…`;
  if (!isBusy()) return null;
  const file = recipe.value?.source.file;
  return file ? `Reading ${file.name}…` : 'Generating the volume…';
}

/** In place of the empty state. */
export function ReadingState() {
  return (
    <div class="reading" role="status">
      <h1>{whatComes()}</h1>
      <progress aria-label="Reading" />
    </div>
  );
}

/** The volume is being read or generated, and none is there to be seen. */
export const volumeComes = () =>
  whatComes() !== null && (volume.value === null || shownKeys.value.volume === undefined);

/** Over a view that still shows the volume before. */
export function ReadingNote() {
  if (activity.value !== 'opening' || volumeComes()) return null;
  return (
    <p class="view-note reading-note" role="status">
      {whatComes()}
    </p>
  );
}

/** In the 3-D view, until there is a surface or a mesh. */
export function SurfaceNote() {
  if (pointsOf(stageShown.value) || volumeComes()) return null;
  const { state, fraction } = stages.value.surface;
  const words = isBusy()
    ? `The ${meshIsGiven.value ? 'mesh is being read' : 'surface is being made'}…`
    : state === 'failed'
      ? 'No surface could be made.'
      : 'There is no surface yet.';
  return (
    <div class="view-note surface-note" role="status">
      {words}
      {isBusy() && <progress max={1} value={fraction || undefined} aria-label="Progress of the surface" />}
    </div>
  );
}
