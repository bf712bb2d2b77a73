import { redoEdit, undoEdit } from '../../store/case/open_case';
import { cancelRun, runAll } from '../../store/run/run_stages';
import { tightMemoryMb } from '../../store/run/budget';
import { exceeded, forecast } from '../../store/run/forecast';
import { volume } from '../../store/case/input';
import { caseName, recipe, redoLabel, undoLabel } from '../../store/case/recipe';
import { elapsedSeconds } from '../../store/run/clock';
import { report, upToDate } from '../../store/run/report';
import { activity } from '../../store/run/stages';
import { dark, theme } from '../../store/view';
import { dialogShown } from '../controls/dialog_shown';
import { ForecastNote } from './forecast_note';
import { seconds } from '../controls/format';
import { Icon } from '../controls/icons';

/** A key that is held down presses once. */
const ignoreRepeats = (event: KeyboardEvent) => event.repeat && event.preventDefault();

/** Run and Cancel are one button, so that the focus stays on it. */
function RunButton() {
  const now = activity.value;
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
        <span key="note" class="elapsed">
          {now === 'preview' ? 'Surface…' : 'Reading…'}
          <button
            type="button"
            class="icon-button small"
            aria-label="Stop"
            title="Stop (Esc)"
            onClick={() => void cancelRun()}
          >
            <Icon name="cross" size={13} />
          </button>
        </span>
      )}
      <button
        type="button"
        key="go"
        class="button primary"
        data-testid="run"
        disabled={volume.value === null || (now !== 'idle' && now !== 'preview')}
        title="Run (Ctrl Enter)"
        onKeyDown={ignoreRepeats}
        onClick={run}
      >
        <Icon name="play" size={13} /> Run
      </button>
    </>
  );
}

export function Header() {
  const hasCase = recipe.value !== null && volume.value !== null;
  return (
    <header class="header">
      <button
        type="button"
        class="brand"
        aria-label="About voxtet"
        title="About voxtet"
        onClick={() => (dialogShown.value = 'about')}
      >
        <svg viewBox="0 0 32 32" width="26" height="26" aria-hidden="true">
          <path class="brand-face" d="M16 4 28 25 4 25Z" />
          <path class="brand-line" d="M16 4 18.5 18.5 28 25M18.5 18.5 4 25" />
        </svg>
        <span class="brand-name">voxtet</span>
      </button>
      {hasCase && (
        <span class="case-name" title={caseName()}>
          {caseName()}
        </span>
      )}
      <span class="spacer" />
      {hasCase && !(upToDate.value && report.value) && <ForecastNote />}
      <div class="group">
        <button
          type="button"
          class="icon-button"
          disabled={undoLabel.value === null}
          aria-label="Undo"
          title={undoLabel.value ? `Undo: ${undoLabel.value}` : 'Nothing to undo'}
          onClick={() => void undoEdit()}
        >
          <Icon name="undo" />
        </button>
        <button
          type="button"
          class="icon-button"
          disabled={redoLabel.value === null}
          aria-label="Redo"
          title={redoLabel.value ? `Redo: ${redoLabel.value}` : 'Nothing to redo'}
          onClick={() => void redoEdit()}
        >
          <Icon name="redo" />
        </button>
      </div>
      <button
        type="button"
        class="icon-button"
        aria-label={dark.value ? 'Light theme' : 'Dark theme'}
        title={dark.value ? 'Light theme' : 'Dark theme'}
        onClick={() => (theme.value = dark.value ? 'light' : 'dark')}
      >
        <Icon name={dark.value ? 'sun' : 'moon'} />
      </button>
      <button
        type="button"
        class="icon-button"
        aria-label="Keys"
        title="Keys (?)"
        onClick={() => (dialogShown.value = 'keys')}
      >
        <Icon name="keys" />
      </button>
      <button type="button" class="button" disabled={!hasCase} onClick={() => (dialogShown.value = 'share')}>
        <Icon name="share" /> Share
      </button>
      <button
        type="button"
        class="button"
        disabled={report.value === null || activity.value !== 'idle'}
        onClick={() => (dialogShown.value = 'export')}
      >
        <Icon name="download" /> Export
      </button>
      <RunButton />
    </header>
  );
}
