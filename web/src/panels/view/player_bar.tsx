import { useEffect } from 'preact/hooks';
import {
  awaitsFrames,
  frameShown,
  frameTimes,
  mayStimulate,
  simulation,
  simulationEndMs,
  simulationOf,
  simulationPart,
} from '../../store/run/frames';
import { keepPlaying, playing, seek, stepFrame, togglePlaying } from '../../store/run/player';
import { pauseSimulation, resumeSimulation } from '../../store/run/simulate';
import { motion, stimulating, time, type Motion } from '../../store/view';
import { extraKeys } from '../controls/extra_keys';
import { short } from '../controls/format';
import { Icon, type IconName } from '../controls/icons';

/** Tenths of a millisecond, or finer where the whole span is short: the number keeps its width while it runs. */
function timeText(ms: number, spanMs: number): string {
  const digits = Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(spanMs))));
  return ms.toFixed(digits);
}

function PlayerButton(props: { icon: IconName; name: string; key_: string; go(): void; disabled?: boolean }) {
  const { icon, name, key_, go, disabled } = props;
  return (
    <button
      type="button"
      class="icon-button"
      aria-label={name}
      title={`${name} (${key_})`}
      disabled={disabled}
      onClick={go}
    >
      <Icon name={icon} size={15} />
    </button>
  );
}

const stateWords = { paused: 'held', done: '', cancelled: 'cancelled', failed: 'did not succeed', none: '' };

/** How far the simulation is, and the button that holds it. */
function Progress() {
  const state = simulation.value;
  const part = Math.floor(100 * simulationPart.value);
  const computing = state === 'running' || state === 'paused';
  const filling = simulationOf.value === 'mechanics' && awaitsFrames.value;
  const words = state === 'running' ? (filling ? 'filling' : 'computing') : stateWords[state];
  return (
    <>
      {words && (
        <span class="player-state">
          {words}, {part} %
        </span>
      )}
      {computing && (
        <button
          type="button"
          class="button small"
          title={state === 'running' ? 'The computation waits' : 'The computation goes on'}
          onClick={state === 'running' ? pauseSimulation : resumeSimulation}
        >
          {state === 'running' ? 'Hold' : 'Go on'}
        </button>
      )}
    </>
  );
}

/** Clicks on the mesh excite it, or tell its numbers again. */
const toggleStimulating = () => {
  if (mayStimulate.value) stimulating.value = !stimulating.value;
};

function StimulateTool() {
  if (!mayStimulate.value) return null;
  return (
    <button
      type="button"
      class="tool"
      aria-pressed={stimulating.value}
      title="A click on the mesh excites it there (S)"
      onClick={toggleStimulating}
    >
      Stimulate
    </button>
  );
}

/** How a body that moves is shown. */
function MotionTool() {
  if (!frameShown.value?.moves) return null;
  const options: [Motion, string][] = [
    ['moved', 'Moved'],
    ['outline', 'With outline'],
    ['rest', 'At rest'],
  ];
  return (
    <select
      class="motion"
      aria-label="Motion"
      title="The body where it moves to, with an outline of it at rest, or at rest"
      value={motion.value}
      onChange={(event) => (motion.value = event.currentTarget.value as Motion)}
    >
      {options.map(([value, text]) => (
        <option key={value} value={value}>
          {text}
        </option>
      ))}
    </select>
  );
}

const playerKeys = {
  s: toggleStimulating,
  k: togglePlaying,
  ',': () => stepFrame(-1),
  '.': () => stepFrame(1),
};

/** Plays what lives in time; there is none without frames. */
export function PlayerBar() {
  useEffect(keepPlaying, []);
  useEffect(() => {
    Object.assign(extraKeys, playerKeys);
    return () => {
      for (const key of Object.keys(playerKeys)) delete extraKeys[key];
    };
  }, []);
  const state = simulation.value;
  const times = frameTimes.value;
  const newest = times.at(-1) ?? 0;
  const computing = state === 'running' || state === 'paused';
  const end = computing ? simulationEndMs.value : newest;
  const shown = frameShown.value?.timeMs ?? 0;
  const text = timeText(shown, end || 1);
  const onKeyDown = (event: KeyboardEvent) => {
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (!way) return;
    event.preventDefault();
    stepFrame(way as 1 | -1);
  };
  return (
    <div class="player" role="group" aria-label="Player" data-state={state} data-frames={times.length}>
      <PlayerButton
        icon="step_back"
        name="Frame before"
        key_=","
        disabled={shown <= (times[0] ?? 0)}
        go={() => stepFrame(-1)}
      />
      <PlayerButton
        icon={playing.value ? 'pause' : 'play'}
        name={playing.value ? 'Pause' : 'Play'}
        key_="K"
        disabled={!computing && times.length < 2}
        go={togglePlaying}
      />
      <PlayerButton
        icon="step_on"
        name="Next frame"
        key_="."
        disabled={shown >= newest}
        go={() => stepFrame(1)}
      />
      <input
        type="range"
        min={times[0] ?? 0}
        max={end}
        step="any"
        value={time.value}
        aria-label="Time"
        aria-valuetext={`${short(shown)} ms`}
        onKeyDown={onKeyDown}
        onInput={(event) => seek(Number(event.currentTarget.value))}
      />
      <output class="player-time">
        {text} <span class="unit">/ {short(end)} ms</span>
      </output>
      <Progress />
      <StimulateTool />
      <MotionTool />
    </div>
  );
}
