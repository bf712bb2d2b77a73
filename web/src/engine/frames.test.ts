import { afterEach, describe, expect, it } from 'vitest';
import { EngineClient } from './client';
import type { Frame, Recipe } from './contract';
import { Workers } from './testing/workers';

const workers = new Workers();
afterEach(() => workers.end());

const recipe = { source: { phantom: {} } } as unknown as Recipe;

describe('a frame', () => {
  it('of a body that moves says how far each point is, and what was recorded since the frame before', async () => {
    const client = new EngineClient(workers.setup());
    await client.run(JSON.stringify(recipe), recipe.source, 'quality');
    const frames: Frame[] = [];
    await client.simulate(JSON.stringify(recipe), recipe.source, 'mechanics', {
      onProgress: () => undefined,
      onFrame: (frame) => void frames.push(frame),
    });
    const [, second] = frames;
    const { count } = second.fields[0];
    expect(second.moves).toEqual(new Float32Array(3 * count).fill(0.1));
    expect(second.fields[0]).toMatchObject({ name: 'displacement_mm', components: 1 });
    expect(second.values.displacement_mm.length).toBe(count);
    expect(second.values.displacement_mm[0]).toBeCloseTo(Math.sqrt(0.03), 6);
    expect(second.fields[0].range?.[1]).toBeCloseTo(Math.sqrt(0.03), 6);
    expect(second.traces?.times_ms).toEqual([7.5, 10]);
    expect(second.traces?.lines[0].values).toEqual([10, 20]);
  });
});
