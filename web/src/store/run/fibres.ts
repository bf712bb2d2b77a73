/** The fibres of the mesh that is shown, asked for when they are to be seen. */
import { computed, effect, signal, untracked } from '@preact/signals';
import type { FibreArrays } from '../../engine/contract';
import { canonicalJson } from '../../link/canonical';
import { fibresAreGiven } from '../case/input';
import { recipe } from '../case/recipe';
import { fibreStyle } from '../view';
import { startClock, stopClock } from './clock';
import { engine, takeTurn, tellError } from './engine';
import { forecastUnderWay } from './forecast';
import { frameTimes, simulation } from './frames';
import { meshedRecipe, upToDate } from './report';
import { shownKeys } from './results';
import { activity } from './stages';

const latest = signal<{ key: string; fibres: FibreArrays | null } | null>(null);

/** Of what fibres are made from; null where the case has none, or there is no mesh of it. */
const wanted = computed(() => {
  const { anatomy, fibres } = recipe.value?.physics ?? {};
  if (!(fibres || fibresAreGiven.value) || !upToDate.value) return null;
  return canonicalJson([shownKeys.value.optimise, anatomy, fibres]);
});

/** Whether there is anything to choose from. */
export const mayShowFibres = computed(() => wanted.value !== null);

/** The fibres to be drawn, once they are there. */
export const fibresShown = computed(() =>
  fibreStyle.value !== 'none' && latest.value?.key === wanted.value ? (latest.value?.fibres ?? null) : null,
);

/** The engine is free, or between two parts of a simulation that has begun to give frames. */
const mayAsk = () =>
  activity.value === 'idle' ||
  ((simulation.value === 'running' || simulation.value === 'paused') && frameTimes.value.length > 0);

/** Keeps them up to date for as long as they are shown, until what it gives is called. */
export function keepFibres(): () => void {
  return effect(() => {
    const key = wanted.value;
    if (fibreStyle.value === 'none' || key === null || latest.value?.key === key || !mayAsk()) return;
    untracked(() => void fetchFibres(key));
  });
}

async function fetchFibres(key: string): Promise<void> {
  const [mesh, physics] = [meshedRecipe.value, recipe.value?.physics];
  if (!mesh) return;
  // Asked once only: what cannot be made is told, and not tried again before something has changed.
  latest.value = { key, fibres: null };
  const own = activity.value === 'idle';
  const newest = own ? takeTurn() : () => true;
  if (own) {
    activity.value = 'run';
    startClock();
  }
  try {
    if (own) await forecastUnderWay()?.done;
    if (!newest()) return;
    const fibres = await engine.fibres(JSON.stringify({ ...mesh, physics }), mesh.source);
    if (latest.value?.key === key) latest.value = { key, fibres };
  } catch (error) {
    if (newest()) tellError(error);
  } finally {
    if (own && newest()) {
      activity.value = 'idle';
      stopClock();
    }
  }
}
