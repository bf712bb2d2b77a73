/** Where the points of the mesh are in the frame that is shown. */
import { computed } from '@preact/signals';
import type { TetArrays } from '../../../engine/contract';
import { motion, stageShown, time } from '../../view';
import { pinnedSimulation } from '../compare';
import { frameShown } from '../frames';
import { shownResult } from '../results';

/** How far each point is from where it was, three numbers a point; null where nothing moves. */
export const movesShown = computed((): Float32Array | null => {
  const moves = motion.value === 'rest' ? undefined : frameShown.value?.moves;
  const points = shownResult('optimise')?.points;
  return moves && moves.length === points?.length ? moves : null;
});

/** The same of the pinned run at the same time. */
export function pinnedMoves(): Float32Array | null {
  return (motion.value !== 'rest' && pinnedSimulation()?.frames.at(time.value)?.moves) || null;
}

/** The mesh with its points where they are seen. */
export const movedMesh = computed((): TetArrays | undefined => {
  const mesh = shownResult('optimise');
  const moves = movesShown.value;
  if (!mesh || !moves) return mesh;
  return { ...mesh, points: mesh.points.map((x, i) => x + moves[i]) };
});

/** Whether an outline shows where the body was at rest. */
export const restOutlined = computed(
  () =>
    motion.value === 'outline' &&
    movesShown.value !== null &&
    (stageShown.value === 'quality' || stageShown.value === 'optimise'),
);
