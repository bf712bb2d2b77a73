import { stageNames, type StageName } from '../engine/contract';
import { shownDigests } from '../store/results';
import { activity, report, stages, upToDate, type StageStatus } from '../store/run';
import { stageShown } from '../store/view';
import { about, seconds } from './format';

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
  sizing: 'The edge length asked for at every place',
  remesh: 'Triangles adapted to the wished edge length',
  optimise: 'The inside filled with labelled tetrahedra, their shapes improved',
  quality: 'Every element measured',
};

/** Stages that are brought up to date after every edit; the others wait for a run. */
const previewed = new Set<StageName>(['volume', 'surface', 'smooth']);

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

export function Pipeline() {
  const outdated = report.value !== null && !upToDate.value;
  const busy = activity.value === 'run' || activity.value === 'preview';
  return (
    <nav class="pipeline" aria-label="Pipeline">
      <ol>
        {stageNames.map((name) => {
          const status = stages.value[name];
          const ready = shownDigests.value[name] !== undefined;
          const stale = outdated && status.state === 'done' && !previewed.has(name);
          return (
            <li key={name}>
              <button
                type="button"
                class={`chip ${stale ? 'stale' : status.state}`}
                aria-current={stageShown.value === name && ready ? 'step' : undefined}
                disabled={!ready}
                title={lessons[name]}
                data-stage={name}
                data-state={status.state}
                onClick={() => (stageShown.value = name)}
              >
                <span class="chip-name">{titles[name]}</span>
                <span class="chip-detail">{detail(name, status)}</span>
                {busy && status.state === 'running' && (
                  <progress
                    max={1}
                    value={status.fraction || undefined}
                    aria-label={`${titles[name]} progress`}
                  />
                )}
              </button>
            </li>
          );
        })}
      </ol>
    </nav>
  );
}
