/** Where a teacher writes a lesson, beside the app that it is about. */
import { useEffect, useState } from 'preact/hooks';
import {
  addStep,
  beginDraft,
  draft,
  draftFault,
  editLesson,
  finished,
  moveStep,
  removeStep,
  tryLesson,
  written,
  draftKept,
  fileTextOf,
} from '../../../lessons/draft';
import { maxSteps } from '../../../lessons/read_lesson';
import { lessonAddress } from '../../../lessons/lesson_link';
import { keepLessonOpen } from '../../../store/case/keep/lesson_asked';
import { dialogShown } from '../../controls/dialog_shown';
import { CopyButton } from '../../controls/copy_button';
import { lengthNote, whole } from '../../controls/format';
import { Icon } from '../../controls/icons';
import { writeFiles } from '../../controls/write_files';
import { StepFields } from './step_fields';
import { TextField } from './text_field';

function LessonFields() {
  const { title, summary, author, language, minutes } = draft.value;
  return (
    <>
      <TextField label="Title of the lesson" value={title} onChange={(next) => editLesson({ title: next })} />
      <TextField
        label="What there is to learn"
        rows={2}
        value={summary}
        onChange={(next) => editLesson({ summary: next })}
      />
      <details class="more">
        <summary>Author, language, time</summary>
        <TextField label="Author" value={author} onChange={(next) => editLesson({ author: next })} />
        <TextField
          label="Language, as en or de"
          value={language}
          onChange={(next) => editLesson({ language: next })}
        />
        <TextField
          label="Minutes it takes"
          value={minutes === undefined ? '' : String(minutes)}
          onChange={(next) => editLesson({ minutes: Number(next) || undefined })}
        />
      </details>
    </>
  );
}

function StepBar() {
  const { steps } = draft.value;
  const at = written.value;
  const tool = (name: 'up' | 'down' | 'trash', label: string, act: () => void, disabled = false) => (
    <button
      type="button"
      class="icon-button small"
      aria-label={label}
      title={label}
      disabled={disabled}
      onClick={act}
    >
      <Icon name={name} size={14} />
    </button>
  );
  return (
    <div class="edit-bounds">
      <select
        aria-label="Step"
        value={at}
        onChange={(event) => (written.value = Number(event.currentTarget.value))}
      >
        {steps.map((step, i) => (
          <option key={i} value={i} selected={i === at}>
            {i + 1}. {step.title || 'Untitled'}
          </option>
        ))}
      </select>
      {tool('up', 'Move the step up', () => moveStep(-1), at === 0)}
      {tool('down', 'Move the step down', () => moveStep(1), at === steps.length - 1)}
      {tool('trash', 'Remove the step', removeStep)}
      <button type="button" class="button small" disabled={steps.length >= maxSteps} onClick={addStep}>
        <Icon name="plus" size={13} /> Step
      </button>
    </div>
  );
}

/** The link of the lesson as it stands; none while something is missing. */
function useLink(): string {
  const [link, setLink] = useState('');
  const current = draft.value;
  useEffect(() => {
    let newest = true;
    if (draftFault()) setLink('');
    else void lessonAddress(finished(), null).then((address) => newest && setLink(address));
    return () => {
      newest = false;
    };
  }, [current]);
  return link;
}

function Ready() {
  const fault = draftFault();
  const link = useLink();
  return (
    <div class="edit-ready">
      {fault ? (
        <p class="stale" data-testid="draft-fault">
          Not ready. {fault}
        </p>
      ) : (
        <>
          <textarea
            class="link"
            readOnly
            rows={2}
            aria-label="Link of the lesson"
            data-testid="lesson-link"
            value={link}
            onFocus={(event) => event.currentTarget.select()}
          />
          <p class="muted">
            {whole(link.length)} characters. {lengthNote(link.length, 'lesson')}
          </p>
        </>
      )}
      <div class="lesson-actions">
        <button type="button" class="button" disabled={fault !== ''} onClick={tryLesson}>
          <Icon name="play" size={13} /> Try it
        </button>
        <button
          type="button"
          class="button"
          disabled={fault !== ''}
          onClick={() => {
            const ready = finished();
            writeFiles(({ downloadLesson }) => downloadLesson(ready.title, fileTextOf(ready)));
          }}
        >
          <Icon name="download" size={13} /> File
        </button>
        <button
          type="button"
          class="button"
          disabled={fault !== ''}
          onClick={() => (dialogShown.value = 'sheet')}
        >
          Sheet
        </button>
        <CopyButton class="button primary" text={link} disabled={link === ''}>
          Copy link
        </CopyButton>
      </div>
    </div>
  );
}

export function LessonEditor() {
  useEffect(() => keepLessonOpen({ from: 'editor' }), []);
  return (
    <div class="lesson-body edit" data-testid="lesson-editor">
      <p class="facts">
        Open a case and set the page as pupils are to find it; then write what they read and are asked.
        {draftKept.value && ' Kept in this browser with every change.'}
      </p>
      {!draftKept.value && (
        <p class="stale">Too long to be kept in this browser: a reload would lose the last changes.</p>
      )}
      <LessonFields />
      <h3>Steps</h3>
      <StepBar />
      <StepFields />
      <h3>Hand it out</h3>
      <Ready />
      <button type="button" class="button small" onClick={() => beginDraft()}>
        Begin another lesson
      </button>
    </div>
  );
}
