/** What is simulated on the mesh that is shown. Its run can be held, and given up without losing the mesh. */
import {
  EngineError,
  type FieldInfo,
  type Physics,
  type promisedStages,
  type SimulationName,
} from '../../engine/contract';
import { recipe } from '../case/recipe';
import { announcement } from '../notices';
import { colourBy, stageShown } from '../view';
import { startClock, stopClock } from './clock';
import { engine, takeTurn, tellError } from './engine';
import { forecastUnderWay } from './forecast';
import {
  awaitsFrames,
  beginFrames,
  endFrames,
  keepFound,
  keepFrame,
  playedFields,
  showFrames,
  simulatedPhysics,
  simulation,
  simulationDigests,
  simulationEndMs,
  simulationOf,
  simulationPart,
  simulationReport,
  type SimulationState,
} from './frames';
import { play } from './player';
import { meshedRecipe } from './report';
import { activity } from './stages';

let count = 0;

/** What frames with these fields are coloured by at first. */
const firstColour = (name: SimulationName, fields: readonly FieldInfo[]): string =>
  name === 'mechanics' ? 'fibre_strain_percent' : fields[0].name;

/** Whether it gives frames, which are played as they come. */
const lives = (name: SimulationName): boolean => name !== 'eikonal';

/** The time up to which a simulation goes, ms. */
function endOf(name: SimulationName, { diffusion, monodomain, mechanics }: Physics): number {
  if (name === 'mechanics') return mechanics ? mechanics.beats * mechanics.period_ms : 0;
  return (name === 'diffusion' ? diffusion : monodomain)?.end_ms ?? 0;
}

/** Computes what the recipe asks for on the mesh that is shown; before a heart that beats by the wave, the wave. */
export async function simulate(name: SimulationName): Promise<void> {
  const beat = recipe.value?.physics?.mechanics;
  if (name === 'mechanics' && beat?.contraction.by === 'monodomain') {
    await simulateOne('monodomain');
    if (simulation.value !== 'done') return;
  }
  await simulateOne(name);
}

async function simulateOne(name: SimulationName): Promise<void> {
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
  let framed = false;
  if (lives(name)) {
    simulationEndMs.value = endOf(name, physics);
    simulationPart.value = 0;
    simulationOf.value = name;
    simulatedPhysics.value = physics;
    simulation.value = 'running';
    awaitsFrames.value = true;
    play();
  }
  stageShown.value = 'quality';
  try {
    await forecastUnderWay()?.done;
    if (!newest()) return settle('cancelled');
    const { summary, found, report } = await engine.simulate(JSON.stringify(current), current.source, name, {
      onProgress(stage, fraction) {
        if (stage === name && newest()) simulationPart.value = fraction;
      },
      onFrame(frame) {
        if (!newest()) return;
        if (!framed) beginFrames(name, frame.timeMs);
        framed = true;
        awaitsFrames.value = false;
        if (playedFields.value.length === 0) colourBy.value = firstColour(name, frame.fields);
        keepFrame(frame);
      },
    });
    if (lives(name) && newest()) {
      (framed ? endFrames : showFrames)(name, summary.key);
      const fields = playedFields.value.map(({ info }) => info);
      if (!framed && fields.length > 0) colourBy.value = firstColour(name, fields);
    }
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
      awaitsFrames.value = false;
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
