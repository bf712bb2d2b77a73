import { redoEdit, undoEdit } from '../../store/case/open_case';
import { volume } from '../../store/case/input';
import { caseName, recipe, redoLabel, undoLabel } from '../../store/case/recipe';
import { report } from '../../store/run/report';
import { mayUse } from '../../store/case/keep/lesson_asked';
import { activity } from '../../store/run/stages';
import { study, studyShown } from '../../store/study/study';
import { dialogShown } from '../controls/dialog_shown';
import { Icon } from '../controls/icons';
import { pageShape, tabbed } from '../controls/page_shape';
import { Appearance } from './appearance';
import { ForecastNote } from './forecast_note';
import { RunButton } from './run_button';

function History() {
  return (
    <>
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
    </>
  );
}

function CaseActions({ hasCase }: { hasCase: boolean }) {
  return (
    <>
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
    </>
  );
}

/** Above a study, which stands in front of the case, it has nothing that changes the case. */
export function Header() {
  const hasCase = recipe.value !== null && volume.value !== null;
  const inFront = studyShown.value;
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
      {study.value && (
        <button
          type="button"
          class="button study-button"
          aria-label="Study"
          title={inFront ? 'Back to the case' : 'Back to the results of the study'}
          aria-pressed={inFront}
          onClick={() => (studyShown.value = !inFront)}
        >
          <Icon name="table" /> <span class="button-text">Study</span>
        </button>
      )}
      {hasCase && !inFront && (
        <span class="case-name" title={caseName()}>
          {caseName()}
        </span>
      )}
      <span class="spacer" />
      {!inFront && <History />}
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
      {!inFront && <CaseActions hasCase={hasCase} />}
    </header>
  );
}
