/** The case of an app that is embedded in another page, and what its one button does. */
import { signal } from '@preact/signals';
import type { SharedView } from '../../engine/contract';
import { decodeFragment, encodeFragment, jsonWithin, parseCase } from '../../link/codec';
import { acceptOffer, offerCase, offered } from '../case/open_case';
import { hasSource, needsNoFile, recipe } from '../case/recipe';
import { awaitedView } from '../case/shared_view';
import { dismissErrors } from '../notices';
import { engine } from '../run/engine';
import { frameTimes } from '../run/frames';
import { playing, stopPlaying, togglePlaying } from '../run/player';
import { upToDate } from '../run/report';
import { cancelRun, runAll } from '../run/run_stages';
import { simulate } from '../run/simulate';
import { activity } from '../run/stages';
import { tellHost } from './host';

/** The case as the fragment of a link, as it was given. */
export const embeddedLink = signal('');

/** What the button is for: a case that was given and has not been run yet, else that of the view. */
export function embeddedRecipe() {
  if (offered.value) return offered.value.recipe;
  return recipe.value && hasSource(recipe.value) ? recipe.value : null;
}

/** Whether the case is there as a whole: an embedded app takes no files. */
export function mayRun(): boolean {
  const current = embeddedRecipe();
  return current !== null && needsNoFile(current);
}

async function endRun(): Promise<void> {
  await cancelRun();
  tellHost({ type: 'voxtet:error', code: 'cancelled', stage: 'engine', message: 'The run was cancelled.' });
}

/** Takes a case: a recipe, or a link with one. Nothing runs. */
export async function openEmbedded(given: object | string): Promise<void> {
  dismissErrors();
  const value =
    typeof given === 'string'
      ? await decodeFragment(given.slice(Math.max(0, given.indexOf('#'))))
      : parseCase(jsonWithin(given));
  await offerCase(value, 'link');
  embeddedLink.value = await encodeFragment(value);
  stopPlaying();
  if (activity.value !== 'idle') await endRun();
}

/** Shows what the `view` of a recipe says, or will once there is something to see. */
export async function showEmbedded(given: object): Promise<void> {
  const { recipe: checked } = await engine.checkRecipe(parseCase(jsonWithin({ view: given })));
  const view = (checked as { view?: SharedView }).view ?? null;
  if (offered.value) offered.value = { ...offered.value, view };
  else awaitedView.value = view;
}

/** Meshes the case, and computes its heartbeat where it has one, or else its wave. */
export async function runEmbedded(): Promise<void> {
  if (!mayRun() || activity.value !== 'idle') return;
  if (offered.value) await acceptOffer(true);
  else await runAll();
  // Another case may have come meanwhile.
  if (offered.value || !upToDate.value) return;
  const { mechanics, monodomain } = recipe.value?.physics ?? {};
  if (mechanics) await simulate('mechanics');
  else if (monodomain) await simulate('monodomain');
}

export interface Task {
  name: 'Run' | 'Cancel' | 'Play' | 'Pause';
  icon: 'play' | 'pause' | 'stop';
  go(): unknown;
}

/** What the button does now; nothing where all is done. */
export function buttonTask(): Task | null {
  if (activity.value === 'preview' || activity.value === 'run')
    return { name: 'Cancel', icon: 'stop', go: endRun };
  if (offered.value || !upToDate.value) return { name: 'Run', icon: 'play', go: runEmbedded };
  if (frameTimes.value.length < 2) return null;
  return playing.value
    ? { name: 'Pause', icon: 'pause', go: togglePlaying }
    : { name: 'Play', icon: 'play', go: togglePlaying };
}
