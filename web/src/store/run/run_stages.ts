/** What makes the engine run: the surface after every edit, and runs up to a stage. */
import { effect, untracked } from '@preact/signals';
import type { Recipe, StageName, VolumeSummary } from '../../engine/contract';
import { engine, takeTurn, tellError } from './engine';
import { forecastUnderWay } from './forecast';
import { awaitedFile, meshIsGiven, volume } from '../case/input';
import { hasSource, recipe } from '../case/recipe';
import { dropResults, isKept, keepResult, showResult, shownKeys } from './results';
import { announcement, dismissErrors } from '../notices';
import { startClock, stopClock } from './clock';
import { forgetReport, meshedRecipe, report } from './report';
import {
  activity,
  caseStages,
  endStages,
  isMadeFrom,
  lastCancelMs,
  previewDue,
  setStage,
  stages,
} from './stages';
import { stageInput } from './stage_inputs';
import {
  brush,
  colourBy,
  command,
  focusTet,
  layout,
  marked,
  picked,
  endSlicesFirst,
  slicesFirst,
  sliceOverlay,
  stageShown,
} from '../view';

let previewTimer: ReturnType<typeof setTimeout> | undefined;
/** The view is to fit the next surface, whichever run brings it. */
let fitDue = false;

function forgetPreview(): void {
  clearTimeout(previewTimer);
  previewDue.value = false;
}

/** The sizing field is on show, and follows the recipe like the surface does. */
function watchesSizing(): boolean {
  const onSurface = stageShown.value === 'surface' || stageShown.value === 'smooth';
  return (
    stageShown.value === 'sizing' ||
    (layout.value === 'slices' && sliceOverlay.value !== 'labels') ||
    (onSurface && (colourBy.value === 'target_mm' || colourBy.value === 'thickness_mm'))
  );
}

/** The label surface, as soon as it exists; of a mesh that is given all that is known. Runs by itself after whatever changes it. False where it was not made. */
export async function preview(fit: boolean): Promise<boolean> {
  forgetPreview();
  fitDue ||= fit;
  return runStages(lastPreviewed(), 'preview');
}

const lastPreviewed = (): StageName =>
  meshIsGiven.value ? 'quality' : watchesSizing() ? 'sizing' : 'smooth';

/** Brings the sizing field up to date whenever it is on show and the recipe changes. */
export function keepSizingShown(): void {
  effect(() => {
    const current = recipe.value;
    if (!watchesSizing() || !current) return;
    untracked(() => {
      if (volume.value && !isMadeFrom(current, 'sizing')) previewSoon();
    });
  });
}

/**
 * A preview ends what the engine is at, so it waits for what the user has asked for: a file read or written. Where
 * there is nothing new to show there is none, and the engine keeps the mesh that it has.
 */
export function previewSoon(): void {
  forgetPreview();
  if (activity.value === 'run') return;
  previewDue.value = true;
  previewTimer = setTimeout(() => {
    const current = recipe.value;
    if (activity.value === 'opening' || activity.value === 'export') previewSoon();
    else if (!current || activity.value === 'preview' || !isMadeFrom(current, lastPreviewed()))
      void preview(false);
    else forgetPreview();
  }, 350);
}

export function runAll(): Promise<void> {
  return runTo('quality');
}

/** Runs up to a stage; those whose input has not changed are kept. */
export async function runTo(last: StageName): Promise<void> {
  forgetPreview();
  await runStages(last, 'run');
}

/** Ends what the engine is at; a forecast from this very surface is waited for, since its stages are wanted. */
async function freeEngine(surface: string): Promise<void> {
  const forecasting = forecastUnderWay();
  if (forecasting?.surface === surface) await forecasting.done;
  else if (engine.busy) await engine.cancel();
}

/** Once the page is drawn; a hidden one is not. */
const drawn = () =>
  new Promise<void>((done) => {
    setTimeout(done, document.hidden ? 0 : 2000);
    requestAnimationFrame(() => requestAnimationFrame(() => done()));
  });

/** False where the stages failed, or where something newer has taken the engine. */
async function runStages(last: StageName, kind: 'preview' | 'run'): Promise<boolean> {
  const current = recipe.value;
  if (!current || !hasSource(current) || awaitedFile.value) return false;
  const newest = takeTurn();
  const names = caseStages.value.slice(0, caseStages.value.indexOf(last) + 1);
  activity.value = kind;
  marked.value = null;
  if (kind === 'run') {
    dismissErrors();
    for (const name of names) setStage(name, { state: 'waiting', fraction: 0 });
    announcement.value = 'Meshing started';
    startClock();
  }
  try {
    await freeEngine(stageInput(current, 'smooth'));
    if (!newest()) return false;
    const result = await engine.run(JSON.stringify(current), current.source, last, {
      onProgress(stage, fraction) {
        if (newest()) setStage(stage, { state: 'running', fraction });
      },
      wants: (summary) => !isKept(summary.name, summary.key),
      onStage(summary, arrays) {
        if (!newest()) return;
        const known = stages.value[summary.name].summary;
        const kept =
          known?.key === summary.key && summary.cached ? { ...summary, seconds: known.seconds } : summary;
        const madeFrom = stageInput(current, summary.name);
        setStage(summary.name, { state: 'done', fraction: 1, summary: kept, madeFrom });
        // Whatever follows the volume is made anew with another one, the same again is none.
        if (summary.name === 'volume' && JSON.stringify(summary.counts) !== JSON.stringify(volume.value))
          volume.value = summary.counts as unknown as VolumeSummary;
        const changed = shownKeys.value[summary.name] !== summary.key;
        if (arrays) keepResult(summary.name, summary.key, arrays);
        // Measures and evidence are of one mesh.
        if (summary.name === 'optimise' && changed) {
          dropResults(['quality']);
          forgetReport();
          brush.value = null;
          focusTet.value = null;
        }
        showResult(summary.name, summary.key);
        const previewed = summary.name === 'smooth' && changed && stageShown.value !== 'surface';
        const first = fitDue && ['surface', 'smooth', 'optimise'].includes(summary.name);
        // What a run has kept is no news, unless it is what was asked for.
        const news = kind === 'run' && (!summary.cached || summary.name === last);
        if (news || previewed || first) stageShown.value = summary.name;
        if (fitDue && (summary.name === 'surface' || summary.name === 'optimise'))
          command.value = { kind: 'fit' };
        if (summary.name === 'smooth' || summary.name === 'optimise') {
          fitDue = false;
          endSlicesFirst();
        }
        // The surface takes all cores, and the first picture needs one.
        if (summary.name === 'volume' && changed && slicesFirst.value) return drawn();
      },
    });
    if (!newest()) return false;
    if (result.report) finishRun(result.report, current);
    else if (kind === 'run') announcement.value = `Ready: ${last}`;
    return true;
  } catch (error) {
    if (!newest()) return false;
    for (const name of names) {
      if (stages.value[name].state === 'running') setStage(name, { state: 'failed', fraction: 0 });
    }
    tellError(error);
    return false;
  } finally {
    if (newest()) {
      activity.value = 'idle';
      stopClock();
    }
  }
}

function finishRun(found: NonNullable<typeof report.value>, current: Recipe): void {
  meshedRecipe.value = current;
  report.value = found;
  brush.value = null;
  focusTet.value = null;
  picked.value = null;
  stageShown.value = 'quality';
  announcement.value = `Mesh ready: ${found.tets.toLocaleString('en')} tetrahedra`;
}

export async function cancelRun(): Promise<void> {
  const newest = takeTurn();
  forgetPreview();
  endStages();
  activity.value = 'idle';
  announcement.value = 'Run cancelled';
  const milliseconds = await engine.cancel();
  if (newest()) lastCancelMs.value = milliseconds;
}
