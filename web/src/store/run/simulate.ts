/** What is simulated on the mesh that is shown. Its run can be held, and given up without losing the mesh. */
import { EngineError } from '../../engine/contract';
import { recipe } from '../case/recipe';
import { announcement } from '../notices';
import { colourBy, stageShown } from '../view';
import { startClock, stopClock } from './clock';
import { engine, takeTurn, tellError } from './engine';
import { forecastUnderWay } from './forecast';
import {
  forgetFrames,
  keepFrame,
  playedFields,
  simulation,
  simulationEndMs,
  type SimulationState,
} from './frames';
import { play } from './player';
import { meshedRecipe } from './report';
import { activity } from './stages';

let count = 0;

/** Runs the diffusion that the recipe asks for, and plays it as it comes. */
export async function simulate(): Promise<void> {
  const physics = recipe.value?.physics;
  if (!meshedRecipe.value || !physics?.diffusion || activity.value !== 'idle') return;
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
  forgetFrames();
  simulationEndMs.value = physics.diffusion.end_ms;
  simulation.value = 'running';
  stageShown.value = 'quality';
  play();
  try {
    await forecastUnderWay()?.done;
    if (!newest()) return settle('cancelled');
    await engine.simulate(JSON.stringify(current), current.source, 'diffusion', {
      onProgress: () => undefined,
      onFrame(frame) {
        if (!newest()) return;
        if (playedFields.value.length === 0) colourBy.value = frame.fields[0].name;
        keepFrame(frame);
      },
    });
    settle('done');
    if (newest()) announcement.value = 'Simulation ready';
  } catch (error) {
    const cancelled = error instanceof EngineError && error.code === 'cancelled';
    settle(cancelled ? 'cancelled' : 'failed');
    if (newest()) tellError(error);
  } finally {
    if (newest()) {
      activity.value = 'idle';
      stopClock();
    }
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
