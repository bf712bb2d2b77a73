/** What is simulated on the mesh that is shown. Its run can be held, and given up without losing the mesh. */
import { EngineError, type promisedStages, type SimulationName } from '../../engine/contract';
import { recipe } from '../case/recipe';
import { announcement } from '../notices';
import { colourBy, stageShown } from '../view';
import { startClock, stopClock } from './clock';
import { engine, takeTurn, tellError } from './engine';
import { forecastUnderWay } from './forecast';
import {
  beginFrames,
  forgetFrames,
  keepFound,
  keepFrame,
  playedFields,
  simulatedPhysics,
  simulation,
  simulationDigests,
  simulationEndMs,
  simulationOf,
  simulationReport,
  type SimulationState,
} from './frames';
import { play } from './player';
import { meshedRecipe } from './report';
import { activity } from './stages';

let count = 0;

/** Whether it gives frames, which are played as they come. */
const lives = (name: SimulationName): boolean => name !== 'eikonal';

/** Computes what the recipe asks for on the mesh that is shown. */
export async function simulate(name: SimulationName): Promise<void> {
  const physics = recipe.value?.physics;
  if (!meshedRecipe.value || !physics || activity.value !== 'idle') return;
  const current = { ...meshedRecipe.value, physics };
  const newest = takeTurn();
  const mine = ++count;
  const settle = (state: SimulationState) => {
    // The frames may be of a later one by now, or gone.
    if (mine === count && simulation.value !== 'none') simulation.value = state;
  };
  activity.value = 'run';
  announcement.value = 'Simulation started';
  startClock();
  const before = simulatedPhysics.value;
  let framed = false;
  if (lives(name)) {
    simulationEndMs.value = (name === 'diffusion' ? physics.diffusion : physics.monodomain)?.end_ms ?? 0;
    simulationOf.value = name;
    simulatedPhysics.value = physics;
    simulation.value = 'running';
    play();
  }
  stageShown.value = 'quality';
  try {
    await forecastUnderWay()?.done;
    if (!newest()) return settle('cancelled');
    const { found, report } = await engine.simulate(JSON.stringify(current), current.source, name, {
      onProgress: () => undefined,
      onFrame(frame) {
        if (!newest()) return;
        if (!framed) beginFrames(name, frame.timeMs);
        framed = true;
        if (playedFields.value.length === 0) colourBy.value = frame.fields[0].name;
        keepFrame(frame);
      },
    });
    // A result that was at hand already gives no frames: those of another case would say something else.
    if (lives(name) && !framed && JSON.stringify(before) !== JSON.stringify(physics)) forgetFrames();
    if (lives(name)) settle('done');
    if (!newest()) return;
    keepFound(found);
    simulationReport.value = report;
    if (!lives(name)) {
      simulatedPhysics.value = physics;
      colourBy.value = found.fields.at(-1)?.name ?? 'label';
    }
    if (newest()) announcement.value = 'Simulation ready';
  } catch (error) {
    const cancelled = error instanceof EngineError && error.code === 'cancelled';
    if (lives(name)) settle(cancelled ? 'cancelled' : 'failed');
    if (newest()) tellError(error);
  } finally {
    if (newest()) {
      activity.value = 'idle';
      stopClock();
    }
  }
}

/** Computes what a link promises, one after the other, for as long as each is done. */
export async function simulatePromised(names: readonly (typeof promisedStages)[number][]): Promise<void> {
  for (const name of names) {
    await simulate(name);
    if (!simulationDigests.value?.stages[name]) return;
  }
}

export function pauseSimulation(): void {
  if (simulation.value !== 'running') return;
  simulation.value = 'paused';
  engine.pauseSimulation(true);
}

export function resumeSimulation(): void {
  if (simulation.value !== 'paused') return;
  simulation.value = 'running';
  play();
  engine.pauseSimulation(false);
}
