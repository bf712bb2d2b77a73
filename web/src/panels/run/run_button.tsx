import { useEffect, useRef } from 'preact/hooks';
import { volume } from '../../store/case/input';
import { elapsedSeconds } from '../../store/run/clock';
import { exceeded, forecast } from '../../store/run/forecast';
import { cancelRun, runAll } from '../../store/run/run_stages';
import { mayUse } from '../../store/case/keep/lesson_asked';
import { activity } from '../../store/run/stages';
import { dialogShown } from '../controls/dialog_shown';
import { seconds } from '../controls/format';
import { Icon } from '../controls/icons';
import { tightMemoryMb } from '../../store/run/budget';

/** A key that is held down presses once. */
const ignoreRepeats = (event: KeyboardEvent) => event.repeat && event.preventDefault();

/** What had the focus is gone, and the user was at work with it. */
const focusIsLost = () => document.activeElement === document.body && navigator.userActivation?.hasBeenActive;

/** Run and Cancel are one button, so that the focus stays on it. It takes the focus that a new case leaves behind. */
export function RunButton() {
  const now = activity.value;
  const button = useRef<HTMLButtonElement>(null);
  const ready = volume.value !== null && mayUse('run') && (now === 'idle' || now === 'preview');
  useEffect(() => {
    if (ready && focusIsLost()) button.current?.focus();
  }, [ready]);
  // Of other sizes there is nothing to ask.
  const numbers = forecast.value?.fresh ? forecast.value.numbers : null;
  const run = () => {
    const tight = numbers && numbers.peak_mb > tightMemoryMb && exceeded.value.length === 0;
    if (tight) dialogShown.value = 'memory';
    else void runAll();
  };
  if (now === 'run' || now === 'export') {
    return (
      <>
        <span key="note" class="elapsed" aria-hidden="true">
          {now === 'run' ? seconds(elapsedSeconds.value) : 'Writing…'}
        </span>
        <button
          type="button"
          key="go"
          ref={button}
          class="button danger"
          data-testid="cancel"
          title="Cancel (Esc)"
          onKeyDown={ignoreRepeats}
          // The second click of a double click on Run lands here, and is not meant.
          onClick={(event) => event.detail < 2 && void cancelRun()}
        >
          <Icon name="stop" size={13} /> Cancel
        </button>
      </>
    );
  }
  return (
    <>
      {(now === 'preview' || now === 'opening') && (
        <>
          <span key="note" class="elapsed">
            {now === 'preview' ? 'Surface…' : 'Reading…'}
          </span>
          <button type="button" key="stop" class="button" title="Stop (Esc)" onClick={() => void cancelRun()}>
            <Icon name="stop" size={13} /> Stop
          </button>
        </>
      )}
      <button
        type="button"
        key="go"
        ref={button}
        class="button primary"
        data-testid="run"
        disabled={!ready}
        title="Run (Ctrl Enter)"
        onKeyDown={ignoreRepeats}
        onClick={run}
      >
        <Icon name="play" size={13} /> Run
      </button>
    </>
  );
}
