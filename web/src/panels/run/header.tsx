import { redoEdit, undoEdit } from '../../store/case/open_case';
import { volume } from '../../store/case/input';
import { caseName, recipe, redoLabel, undoLabel } from '../../store/case/recipe';
import { report } from '../../store/run/report';
import { mayUse } from '../../store/case/keep/lesson_asked';
import { activity } from '../../store/run/stages';
import { dialogShown } from '../controls/dialog_shown';
import { Icon } from '../controls/icons';
import { pageShape, tabbed } from '../controls/page_shape';
import { Appearance } from './appearance';
import { ForecastNote } from './forecast_note';
import { RunButton } from './run_button';

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
      {!tabbed.value && <ForecastNote />}
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
      <Appearance />
      {pageShape.value !== 'phone' && (
        <button
          type="button"
          class="icon-button"
          aria-label="Lessons"
          title="Lessons"
          onClick={() => (dialogShown.value = 'lessons')}
        >
          <Icon name="lesson" />
        </button>
      )}
      <button
        type="button"
        class="icon-button"
        aria-label="Keys"
        title="Keys (?)"
        onClick={() => (dialogShown.value = 'keys')}
      >
        <Icon name="keys" />
      </button>
      <button
        type="button"
        class="button"
        aria-label="Share"
        disabled={!hasCase}
        onClick={() => (dialogShown.value = 'share')}
      >
        <Icon name="share" /> <span class="button-text">Share</span>
      </button>
      <button
        type="button"
        class="button"
        aria-label="Export"
        disabled={report.value === null || activity.value !== 'idle' || !mayUse('export')}
        onClick={() => (dialogShown.value = 'export')}
      >
        <Icon name="download" /> <span class="button-text">Export</span>
      </button>
      {!tabbed.value && <RunButton />}
    </header>
  );
}
