import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { EngineClient } from '../../engine/client';
import { useEngine } from './engine';
import { startRecipe } from '../case/recipe';
import { activity } from './stages';
import { previewSoon } from './run_stages';

const cancel = vi.fn(async () => 0);
const run = vi.fn(() => new Promise(() => undefined));

beforeEach(() => {
  vi.useFakeTimers();
  useEngine({ busy: true, cancel, run } as unknown as EngineClient);
  startRecipe({ source: { phantom: { kind: 'sphere' } } } as never);
});
afterEach(() => void vi.useRealTimers());

it.each(['opening', 'export'] as const)('a preview waits for the end of %s', async (asked) => {
  vi.clearAllMocks();
  activity.value = asked;
  previewSoon();
  await vi.advanceTimersByTimeAsync(2000);
  expect(cancel).not.toHaveBeenCalled();
  activity.value = 'idle';
  await vi.advanceTimersByTimeAsync(400);
  expect(run).toHaveBeenCalledOnce();
});
