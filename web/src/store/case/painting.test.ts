import { beforeEach, expect, it } from 'vitest';
import type { EngineClient } from '../../engine/client';
import type { Recipe, VolumeFile, VolumeSummary } from '../../engine/contract';
import { readOwnNrrd } from '../../geometry/nrrd';
import { undoEdit } from './open_case';
import { useEngine } from '../run/engine';
import { volume } from './input';
import {
  beginStroke,
  brushTool,
  continueStroke,
  endStroke,
  forgetPainting,
  paintedVoxels,
  strokesDone,
} from './painting';
import { recipe, startRecipe } from './recipe';

const painted = () => paintedVoxels()?.labels.reduce((sum, label) => sum + (label > 0 ? 1 : 0), 0) ?? 0;
let held: VolumeFile[] = [];

beforeEach(() => {
  held = [];
  const files = { keepSide: (_: string, file: VolumeFile) => held.push(file) };
  useEngine({ files } as unknown as EngineClient);
  forgetPainting();
  startRecipe({ source: {}, sizing: { masks: [], images: [] } } as unknown as Recipe);
  volume.value = {
    size: [20, 20, 20],
    spacing_mm: [1, 1, 1],
    index_to_mm: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  } as unknown as VolumeSummary;
  brushTool.value = { on: true, erases: false, flat: false, radius_mm: 2, edge_mm: 1 };
});

it('a stroke that another one begins in is a step of its own', async () => {
  beginStroke([5, 5, 5], 2);
  beginStroke([14, 14, 14], 2);
  endStroke();
  await strokesDone();
  await undoEdit();
  expect(painted()).toBeGreaterThan(0);
  await undoEdit();
  expect(painted()).toBe(0);
  expect(recipe.value?.sizing.masks).toEqual([]);
});

it('undo ends the stroke under way and takes it back', async () => {
  beginStroke([5, 5, 5], 2);
  continueStroke([9, 5, 5]);
  await undoEdit();
  expect(painted()).toBe(0);
  expect(recipe.value?.sizing.masks).toEqual([]);
});

it('hands the voxels of a stroke over under its own digest, not those of the next', async () => {
  beginStroke([5, 5, 5], 2);
  endStroke();
  const first = painted();
  beginStroke([14, 14, 14], 2);
  await new Promise((later) => setTimeout(later, 50));
  const voxels = readOwnNrrd(held[0].bytes)?.voxels ?? [];
  expect([...voxels].filter((label) => label > 0)).toHaveLength(first);
  endStroke();
  await strokesDone();
});
