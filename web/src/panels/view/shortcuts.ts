import { useEffect } from 'preact/hooks';
import { stageNames } from '../../engine/contract';
import { redoEdit, undoEdit } from '../../store/case/open_case';
import { cancelRun, runAll } from '../../store/run/run_stages';
import { pinned } from '../../store/run/compare';
import { writeFiles } from '../controls/write_files';
import { volume } from '../../store/case/input';
import { shownKeys } from '../../store/run/results';
import { mayUse } from '../../store/case/keep/lesson_asked';
import { activity } from '../../store/run/stages';
import { studyShown } from '../../store/study/study';
import { dialogShown } from '../controls/dialog_shown';
import { extraKeys } from '../controls/extra_keys';
import { brush, chooseLayout, command, cut, focusTet, picked, showEdges, stageShown } from '../../store/view';

/** Keys of the view, for whoever is not typing. */
const viewKeys: Record<string, () => void> = {
  '1': () => chooseLayout('model'),
  '2': () => chooseLayout('slices'),
  '3': () => pinned.value && chooseLayout('compare'),
  c: () => (cut.value = { ...cut.value, on: !cut.value.on }),
  e: () => (showEdges.value = !showEdges.value),
  f: () => (command.value = { kind: 'fit' }),
  p: () => writeFiles(({ downloadPicture }) => downloadPicture()),
  '?': () => (dialogShown.value = 'keys'),
  '[': () => stepStage(-1),
  ']': () => stepStage(1),
};

/** The stage before or after the one that is shown, of those that have a result. */
function stepStage(way: 1 | -1): void {
  const ready = stageNames.filter((name) => shownKeys.value[name] !== undefined);
  const next = ready[ready.indexOf(stageShown.value) + way];
  if (next) stageShown.value = next;
}

function showAll(): boolean {
  if (brush.value === null && focusTet.value === null && picked.value === null) return false;
  brush.value = null;
  focusTet.value = null;
  picked.value = null;
  return true;
}

function escape(): boolean {
  if (!['run', 'preview', 'opening', 'export'].includes(activity.value)) return showAll();
  void cancelRun();
  return true;
}

/** Whether the key meant something. */
function obeyKey(event: KeyboardEvent): boolean {
  // What is behind a dialog, or a study, stays as it is.
  if (studyShown.value || document.querySelector('dialog[open]')) return false;
  const held = event.ctrlKey || event.metaKey;
  const { target } = event;
  const writes = target instanceof HTMLInputElement && (target.type === 'text' || target.type === 'number');
  const typing = writes || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
  const key = event.key.toLowerCase();
  if (event.key === 'Escape') return escape();
  if (held && event.key === 'Enter') {
    if (!mayUse('run') || !['idle', 'preview'].includes(activity.value)) return false;
    void runAll();
  } else if (held && key === 'z' && !(writes && target.type === 'text'))
    void (event.shiftKey ? redoEdit : undoEdit)();
  else if (held && key === 'y' && !(writes && target.type === 'text')) void redoEdit();
  else if (held || event.altKey || typing) return false;
  else if ((volume.value || key === '?') && Object.hasOwn(viewKeys, key)) viewKeys[key]();
  else if (Object.hasOwn(extraKeys, key)) extraKeys[key]();
  else return false;
  return true;
}

export function useShortcuts(): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (obeyKey(event)) event.preventDefault();
    };
    window.addEventListener('keydown', onKey);
    return () => window.removeEventListener('keydown', onKey);
  }, []);
}
