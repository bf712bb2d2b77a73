import { useEffect, useState } from 'preact/hooks';
import { allowedControls, lessonAsked, mayUse } from '../store/case/keep/lesson_asked';
import { dropFiles } from '../store/case/open_files';
import { announcement, dismiss, notices } from '../store/notices';
import { activity, lastCancelMs } from '../store/run/stages';
import { study, studyShown } from '../store/study/study';
import { CasePanel } from './case/case_panel';
import { Dialogs } from './dialogs/dialogs';
import { EvidencePanel } from './evidence/evidence_panel';
import { Header } from './run/header';
import { Icon } from './controls/icons';
import { Explanation } from './controls/explain';
import { fetched } from './controls/fetched';
import { pageShape, pageTab, tabbed } from './controls/page_shape';
import { Panel } from './controls/panel';
import { Pipeline } from './run/pipeline';
import { TabBar } from './run/tab_bar';
import { useShortcuts } from './view/shortcuts';
import { ViewPanel } from './view/view_panel';

const AskedLesson = fetched(() => import('./lessons/lesson_panel').then((part) => part.AskedLesson));
const StudyResults = fetched(() => import('./study/study_panel').then((part) => part.StudyResults));

/** A lesson stands above the case, or in its place where a step leaves nothing of it. */
function lessonPlace(): 'beside' | 'alone' | undefined {
  if (!lessonAsked.value) return undefined;
  const inCase = [...(allowedControls.value ?? [])].some(
    (name) => !['run', 'evidence', 'export'].includes(name),
  );
  return allowedControls.value && !inCase ? 'alone' : 'beside';
}

function Notices() {
  return (
    <div class="notices" role="region" aria-label="Messages">
      {notices.value.map((notice) => (
        <div
          key={notice.id}
          class={`notice ${notice.tone}`}
          role={notice.tone === 'error' ? 'alert' : 'status'}
        >
          <Icon name={notice.tone === 'error' ? 'warn' : 'check'} size={18} />
          <div>
            <strong>{notice.title}</strong>
            <p>{notice.text}</p>
            {notice.way && (
              <button type="button" class="button small" onClick={notice.way.go}>
                {notice.way.name}
              </button>
            )}
          </div>
          <button
            type="button"
            class="icon-button small"
            aria-label="Dismiss"
            onClick={() => dismiss(notice.id)}
          >
            <Icon name="cross" size={14} />
          </button>
        </div>
      ))}
    </div>
  );
}

function useDrop(): boolean {
  const [over, setOver] = useState(false);
  useEffect(() => {
    let depth = 0;
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    const onEnter = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      depth++;
      setOver(true);
    };
    const onLeave = () => {
      depth = Math.max(0, depth - 1);
      if (depth === 0) setOver(false);
    };
    const onOver = (event: DragEvent) => event.preventDefault();
    const onDrop = (event: DragEvent) => {
      event.preventDefault();
      depth = 0;
      setOver(false);
      void dropFiles([...(event.dataTransfer?.files ?? [])]);
    };
    window.addEventListener('dragenter', onEnter);
    window.addEventListener('dragleave', onLeave);
    window.addEventListener('dragover', onOver);
    window.addEventListener('drop', onDrop);
    return () => {
      window.removeEventListener('dragenter', onEnter);
      window.removeEventListener('dragleave', onLeave);
      window.removeEventListener('dragover', onOver);
      window.removeEventListener('drop', onDrop);
    };
  }, []);
  return over;
}

export function App() {
  useShortcuts();
  const over = useDrop();
  return (
    <div
      class="app"
      data-activity={activity.value}
      data-cancel-ms={lastCancelMs.value?.toFixed(1)}
      data-shape={pageShape.value}
      data-tab={tabbed.value ? pageTab.value : undefined}
      data-lesson={lessonPlace()}
      data-front={studyShown.value ? 'study' : undefined}
    >
      <Header />
      {lessonAsked.value && (
        <Panel part="lesson" class="lesson" label="Lesson">
          <AskedLesson />
        </Panel>
      )}
      <CasePanel />
      <ViewPanel />
      {mayUse('evidence') ? <EvidencePanel /> : <Panel part="evidence" class="right" label="Evidence" />}
      <Pipeline />
      {tabbed.value && <TabBar />}
      {study.value && <StudyResults />}
      <Notices />
      <Dialogs />
      <Explanation />
      {over && (
        <div class="drop-over" aria-hidden="true">
          <span>Drop the volume</span>
        </div>
      )}
      <div class="sr" role="status" aria-live="polite">
        {announcement.value}
      </div>
    </div>
  );
}
