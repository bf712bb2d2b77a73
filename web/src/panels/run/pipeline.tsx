import { useState } from 'preact/hooks';
import type { StageName } from '../../engine/contract';
import { runTo } from '../../store/run/run_stages';
import { volume } from '../../store/case/input';
import { shownKeys } from '../../store/run/results';
import { mayUse } from '../../store/case/keep/lesson_asked';
import { activity, caseStages, stages, staleStages, type StageStatus } from '../../store/run/stages';
import { stageShown } from '../../store/view';
import { about, seconds } from '../controls/format';
import { Icon } from '../controls/icons';
import { pageShape, showView, tabbed } from '../controls/page_shape';
import { ForecastNote } from './forecast_note';

const titles: Record<StageName, string> = {
  volume: 'Volume',
  surface: 'Surface',
  smooth: 'Smooth',
  sizing: 'Sizing',
  remesh: 'Remesh',
  optimise: 'Tetrahedra',
  quality: 'Quality',
};

const lessons: Record<StageName, string> = {
  volume: 'The labels, voxel by voxel',
  surface: 'Boundaries of the labels, staircase and all',
  smooth: 'The same boundaries without the staircase, volumes kept',
  sizing: 'The target edge length at every place',
  remesh: 'Triangles adapted to the target edge length',
  optimise: 'The inside filled with labelled tetrahedra, their shapes improved',
  quality: 'Every element measured',
};

function detail(name: StageName, status: StageStatus): string {
  if (status.state === 'running')
    return status.fraction > 0 ? `${Math.round(100 * status.fraction)} %` : 'running';
  if (status.state === 'failed') return 'did not succeed';
  if (!status.summary) return name === 'volume' ? 'no volume yet' : 'not run';
  const counts = status.summary.counts as Record<string, number & number[]>;
  const size =
    name === 'volume'
      ? `${about(counts.size.reduce((product, n) => product * n, 1))} voxels`
      : name === 'sizing'
        ? `${counts.min_mm.toFixed(1)}–${counts.max_mm.toFixed(1)} mm`
        : name === 'optimise'
          ? `${about(counts.tets)} tets`
          : name === 'quality'
            ? 'measured'
            : `${about(counts.triangles)} triangles`;
  return `${size}, ${seconds(status.summary.seconds)}`;
}

/** All of it in one line, where there is no room for the stages side by side. */
function PipelineNow({ open, onToggle }: { open: boolean; onToggle(): void }) {
  const shown = shownKeys.value[stageShown.value] === undefined ? 'volume' : stageShown.value;
  const { value: all } = stages;
  const running = caseStages.value.find((name) => all[name].state === 'running');
  const name = running ?? shown;
  return (
    <button type="button" class="pipeline-now" aria-expanded={open} aria-controls="stages" onClick={onToggle}>
      <span class="pipeline-steps" aria-hidden="true">
        {caseStages.value.map((one) => (
          <span key={one} class={`${stateOf(one)}${one === shown ? ' shown' : ''}`} />
        ))}
      </span>
      <span class="chip-name">{titles[name]}</span>
      <span class="chip-detail">{detail(name, all[name])}</span>
      <Icon name={open ? 'down' : 'up'} size={14} />
    </button>
  );
}

function stateOf(name: StageName): StageStatus['state'] | 'outdated' {
  return staleStages.value.has(name) ? 'outdated' : stages.value[name].state;
}

export function Pipeline() {
  const [open, setOpen] = useState(false);
  const touched = staleStages.value;
  const idle = activity.value === 'idle' && volume.value !== null && mayUse('run');
  const busy = activity.value === 'run' || activity.value === 'preview';
  const folded = pageShape.value === 'phone';
  return (
    <nav class={open ? 'pipeline open' : 'pipeline'} aria-label="Pipeline">
      {folded && <PipelineNow open={open} onToggle={() => setOpen(!open)} />}
      {tabbed.value && <ForecastNote />}
      <ol id="stages">
        {caseStages.value.map((name) => {
          const status = stages.value[name];
          const ready = shownKeys.value[name] !== undefined;
          const stale = touched.has(name);
          return (
            <li key={name}>
              <button
                type="button"
                class={`chip ${stateOf(name)}`}
                aria-current={stageShown.value === name && ready ? 'step' : undefined}
                disabled={!ready}
                title={stale ? `${lessons[name]}. The recipe has changed since.` : lessons[name]}
                data-stage={name}
                data-state={stale ? 'stale' : status.state}
                data-kept={status.summary?.cached}
                onClick={() => {
                  stageShown.value = name;
                  setOpen(false);
                  showView();
                }}
              >
                <span class="chip-name">{titles[name]}</span>
                <span class="chip-detail">
                  {stale && <span class="chip-stale">changed · </span>}
                  {detail(name, status)}
                </span>
                {folded && <span class="chip-lesson">{lessons[name]}</span>}
                {busy && status.state === 'running' && (
                  <progress
                    max={1}
                    value={status.fraction || undefined}
                    aria-label={`${titles[name]} progress`}
                  />
                )}
              </button>
              {idle && (stale || status.state === 'waiting' || status.state === 'failed') && (
                <button
                  type="button"
                  class="run-to"
                  aria-label={`Run to ${titles[name]}`}
                  title={`Run to here: ${titles[name]}`}
                  onClick={() => void runTo(name)}
                >
                  <Icon name="play" size={11} />
                </button>
              )}
            </li>
          );
        })}
      </ol>
    </nav>
  );
}
