import { writeLesson } from '../../lessons/course';
import { shipped } from '../../lessons/shipped';
import { lessonAsked } from '../../store/case/keep/lesson_asked';
import { openFiles } from '../../store/case/open_files';
import { FileInput } from '../controls/file_input';
import { Icon } from '../controls/icons';

/** Lessons to take, and the ways to one's own. */
export function LessonList({ onOpen }: { onOpen(): void }) {
  return (
    <>
      <p>
        Each takes some ten minutes, in the app itself: try something, then answer one question a step.
        Answers are checked by the app’s own numbers.
      </p>
      <ol class="lesson-list" aria-label="Lessons">
        {shipped.map(({ name, title, text }) => (
          <li key={name}>
            <button
              type="button"
              onClick={() => {
                lessonAsked.value = { from: 'page', name };
                onOpen();
              }}
            >
              <span class="gallery-title">{title}</span>
              <span class="gallery-text">{text}</span>
            </button>
          </li>
        ))}
      </ol>
      <div class="dialog-actions">
        <FileInput
          class="button"
          testId="lesson-file"
          onFiles={(files) => {
            void openFiles(files);
            onOpen();
          }}
        >
          <Icon name="file" /> Open a lesson…
        </FileInput>
        <button
          type="button"
          class="button"
          onClick={() => {
            writeLesson();
            onOpen();
          }}
        >
          Write a lesson…
        </button>
      </div>
    </>
  );
}
