import { useEffect } from 'preact/hooks';
import { buttonTask, embeddedLink, embeddedRecipe, mayRun } from '../../store/embed/embedded_case';
import { volume } from '../../store/case/input';
import { offered } from '../../store/case/open_case';
import { announcement, notices } from '../../store/notices';
import { simulation, simulationEndMs } from '../../store/run/frames';
import { keepPlaying } from '../../store/run/player';
import { report, verdict } from '../../store/run/report';
import { activity, stages } from '../../store/run/stages';
import { layout, time } from '../../store/view';
import { short, whole } from '../controls/format';
import { Icon } from '../controls/icons';
import { SceneHost } from '../view/scene_host';
import { ReadingState, SurfaceNote, volumeComes } from '../view/under_way';
import { ViewCards } from '../view/view_cards';

/** The case before anybody has run it. */
function Poster() {
  const current = embeddedRecipe();
  if (activity.value === 'starting') return null;
  if (!current) return <p class="poster">There is no case: the page around gives one, or the link.</p>;
  const { source, sizing } = current;
  const name = source.phantom?.kind.replaceAll('_', ' ') ?? source.inline?.name ?? source.file?.name;
  const promised = offered.value?.promise?.expected.tets;
  return (
    <div class="poster">
      <h1>{name}</h1>
      <p>
        Edge length {sizing.edge_mm} mm{promised ? `, ${whole(promised)} tetrahedra promised` : ''}
      </p>
      {!mayRun() && <p>It is made from a file, which can be opened in voxtet itself.</p>}
    </div>
  );
}

const verdictWords = {
  reproduced: 'reproduced byte for byte',
  differs: 'differs from what was promised',
  other_engine: 'made with another engine than promised',
};

/** What goes on, or came. */
function statusText(): string {
  const failed = notices.value.find(({ tone }) => tone === 'error');
  if (failed) return `${failed.title}. ${failed.text}`;
  if (simulation.value === 'running')
    return `Wave at ${short(time.value)} of ${short(simulationEndMs.value)} ms`;
  if (activity.value === 'starting') return 'Starting the engine…';
  const running = Object.entries(stages.value).find(([, { state }]) => state === 'running');
  if (running) return `${running[0]} ${Math.round(100 * running[1].fraction)} %`;
  if (!report.value || offered.value) return '';
  const found = verdict.value ? `, ${verdictWords[verdict.value.mesh]}` : '';
  return `${whole(report.value.tets)} tetrahedra${found}`;
}

/** The app as a part of another page: the view, one button, and the way to the whole app. */
export function Embed() {
  useEffect(keepPlaying, []);
  const task = buttonTask();
  const shown = volume.value !== null && !offered.value && !volumeComes();
  const status = statusText();
  const failed = notices.value.some(({ tone }) => tone === 'error');
  const ready = activity.value !== 'starting' && (task?.name !== 'Run' || mayRun());
  return (
    <div class="app embed" data-activity={activity.value}>
      <main class="view" aria-label="View" data-layout={layout.value}>
        <div class="view-body">
          <SceneHost shown={shown} />
          {shown && <ViewCards />}
          {shown && <SurfaceNote />}
          {!shown && (volumeComes() ? <ReadingState /> : <Poster />)}
        </div>
      </main>
      <footer class="embed-bar">
        {task && (
          <button
            type="button"
            class={task.name === 'Cancel' ? 'button danger' : 'button primary'}
            data-testid="embed-button"
            disabled={!ready}
            // The second click of a double click on Run lands on Cancel, and is not meant.
            onClick={(event) => event.detail < 2 && void task.go()}
          >
            <Icon name={task.icon} size={13} /> {task.name}
          </button>
        )}
        <span
          class={failed ? 'embed-status failed' : 'embed-status'}
          role={failed ? 'alert' : undefined}
          title={status}
        >
          {status}
        </span>
        <a href={`./${embeddedLink.value}`} target="_blank" rel="noopener">
          Open in voxtet
        </a>
      </footer>
      <div class="sr" role="status" aria-live="polite">
        {announcement.value}
      </div>
    </div>
  );
}
