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
  dropStroke,
  endStroke,
  forgetPainting,
  paintedVoxels,
  strokesDone,
} from './painting';
import { recipe, startRecipe } from './recipe';
import { notices } from '../notices';
import { dropResults, keepResult, showResult } from '../run/results';

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
    labels: [],
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

it('a stroke that is taken back leaves voxels and history as they were', async () => {
  beginStroke([5, 5, 5], 2);
  endStroke();
  await strokesDone();
  const [voxels, before] = [painted(), recipe.value];
  beginStroke([14, 14, 14], 2);
  continueStroke([5, 5, 5]);
  dropStroke();
  await strokesDone();
  expect(painted()).toBe(voxels);
  expect(recipe.value).toBe(before);
});

it('says where all of a stroke is in labels that are not meshed', async () => {
  const labels = new Uint8Array(8000).fill(1).fill(2, 4000);
  keepResult('volume', 'two halves', { labels });
  showResult('volume', 'two halves');
  startRecipe({ ...recipe.value, labels: [1], legend: [] } as unknown as Recipe);
  notices.value = [];
  beginStroke([10, 10, 9], 2);
  endStroke();
  await strokesDone();
  expect(notices.value).toEqual([]);
  beginStroke([10, 10, 16], 2);
  endStroke();
  await strokesDone();
  expect(notices.value.map(({ text }) => text).join()).toContain('label 2 is not meshed');
  dropResults(['volume']);
});
