import { afterEach, describe, expect, it } from 'vitest';
import { EngineClient } from './client';
import {
  EngineError,
  stageNames,
  type Frame,
  type Recipe,
  type StageArrays,
  type Stimulus,
} from './contract';
import { mockFile, Workers } from './testing/workers';

const phantom = { source: { phantom: {} } } as unknown as Recipe;

let workers = new Workers();

function start(): EngineClient {
  workers = new Workers();
  return new EngineClient(workers.setup());
}

afterEach(() => workers.end());

async function failureOf(promise: Promise<unknown>): Promise<EngineError> {
  const error = await promise.then(
    () => null,
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(EngineError);
  return error as EngineError;
}

describe('EngineClient', () => {
  it('tells schema and defaults once it is up', async () => {
    const info = await start().ready;
    expect(info.schema.version).toBe('mock');
    expect(info.defaults.sizing.edge_mm).toBe(2);
  });

  it('hands over every stage in order, with its arrays, and ends in a report', async () => {
    const client = start();
    const seen: string[] = [];
    const progressed = new Set<string>();
    let neighbours = 0;
    const result = await client.run(JSON.stringify(phantom), phantom.source, 'quality', {
      onProgress: (stage) => progressed.add(stage),
      onStage(summary, arrays) {
        seen.push(summary.name);
        if (arrays && 'neighbours' in arrays) neighbours = arrays.neighbours?.length ?? 0;
      },
    });
    expect(seen).toEqual([...stageNames]);
    expect([...progressed]).toEqual([...stageNames]);
    expect(neighbours).toBe(4 * (result.report?.tets ?? 0));
  });

  it('measures a mesh that was made elsewhere at once, and makes none', async () => {
    const client = start();
    const file = mockFile('heart.elem');
    const summary = await client.openVolume(file);
    expect(summary.mesh?.tets).toBe(1);
    const source = { file: { name: file.name, sha256: summary.digest, url: '' } };
    const result = await client.run(JSON.stringify({ source }), source, 'smooth');
    expect(result.summaries.map(({ name }) => name)).toEqual(['volume', 'optimise', 'quality']);
    expect(result.report).toBeDefined();
  });

  it('hands over what was transferred from the image, and nothing where no label was asked for', async () => {
    const client = start();
    const arraysOf = async (labels: number[]) => {
      const names: string[] = [];
      const recipe = JSON.stringify({ ...phantom, transfer: { labels } });
      await client.run(recipe, phantom.source, 'quality', {
        onStage: (summary, arrays) => {
          if (summary.name === 'quality')
            names.push(...(arrays as StageArrays['quality']).fields.map(({ name }) => name));
        },
      });
      return names.filter((name) => name.endsWith('_label') || name.startsWith('fraction'));
    };
    expect(await arraysOf([5, 6])).toEqual(['centroid_label', 'majority_label', 'fraction_5', 'fraction_6']);
    expect(await arraysOf([])).toEqual([]);
  });

  it('foretells what meshing will take, and the sizes for a number of tetrahedra', async () => {
    const client = start();
    const found = await client.forecast(JSON.stringify(phantom), phantom.source);
    expect(found).toMatchObject({ tets: 125_000 });
    expect(found.fitting).toBeUndefined();
    const { fitting } = await client.forecast(JSON.stringify(phantom), phantom.source, 1_000_000);
    expect(fitting?.sizing.edge_mm).toBeCloseTo(1, 6);
  });

  it('ends a search for sizes that is called off, and begins none that was before its turn', async () => {
    const client = start();
    await client.forecast(JSON.stringify(phantom), phantom.source);
    workers.hang = 'forecast';
    const search = new AbortController();
    const ask = () => client.forecast(JSON.stringify(phantom), phantom.source, 1_000_000, search.signal);
    const failures = Promise.all([failureOf(ask()), failureOf(ask())]);
    await new Promise((later) => setTimeout(later, 40));
    expect(client.busy).toBe(true);
    search.abort();
    expect((await failures).map(({ code }) => code)).toEqual(['cancelled', 'cancelled']);
    expect(client.busy).toBe(false);
    expect(workers.spawned).toBe(3);
    workers.hang = null;
    expect(await client.forecast(JSON.stringify(phantom), phantom.source)).toMatchObject({ tets: 125_000 });
  });

  it('gives a mask to every new worker that needs it, and only once to each', async () => {
    const client = start();
    const sizing = { masks: [{ name: 'paint.nrrd', sha256: '', edges: [{ label: 1, edge_mm: 1 }] }] };
    const recipe = JSON.stringify({ ...phantom, sizing });
    const missing = await failureOf(client.run(recipe, phantom.source, 'sizing'));
    expect(missing.message).toContain('paint.nrrd');
    expect((await client.openSideVolume('mask', mockFile('paint.nrrd'))).labels).toEqual([1]);
    await client.run(recipe, phantom.source, 'sizing');
    expect(workers.sideLoads).toBe(1);
    await client.cancel();
    await client.run(recipe, phantom.source, 'sizing');
    await client.run(recipe, phantom.source, 'sizing');
    expect(workers.sideLoads).toBe(2);
    client.files.keepSide('mask', mockFile('paint.nrrd', 64), '');
    await client.run(recipe, phantom.source, 'sizing');
    expect(workers.sideLoads).toBe(3);
  });

  it('tells no progress of a stage that is done', async () => {
    const client = start();
    workers.late = true;
    const told: string[] = [];
    await client.run(JSON.stringify(phantom), phantom.source, 'smooth', {
      onProgress: (stage) => told.at(-1) !== stage && told.push(stage),
      onStage: ({ name }) => told.push(`${name} done`),
    });
    await new Promise((later) => setTimeout(later, 40));
    expect(told).toEqual(['volume', 'surface', 'smooth'].flatMap((name) => [name, `${name} done`]));
  });

  it('copies no arrays that are not wanted', async () => {
    const handed: string[] = [];
    await start().run(JSON.stringify(phantom), phantom.source, 'smooth', {
      wants: (summary) => summary.name !== 'surface',
      onStage: (summary, arrays) => arrays && handed.push(summary.name),
    });
    expect(handed).toEqual(['volume', 'smooth']);
  });

  it('rejects a damaged file with its name and reason, and keeps the earlier volume', async () => {
    const client = start();
    const good = await client.openVolume(mockFile('good.nii'));
    const error = await failureOf(client.openVolume(mockFile('cut.nii', 3)));
    expect(error.code).toBe('bad_input');
    expect(error.message).toContain('cut.nii');
    const source = { file: { name: 'good.nii', sha256: good.digest, url: '' } };
    await client.run(JSON.stringify({ source }), source, 'smooth');
    expect(workers.loads).toBe(3);
  });

  it('answers cancel although the worker hangs, and runs again with the volume it had', async () => {
    const client = start();
    const { digest } = await client.openVolume(mockFile('heart.nii'));
    const source = { file: { name: 'heart.nii', sha256: digest, url: '' } };
    workers.hang = 'remesh';
    const run = failureOf(client.run(JSON.stringify({ source }), source, 'quality'));
    await new Promise((later) => setTimeout(later, 60));
    expect(client.busy).toBe(true);
    const milliseconds = await client.cancel();
    expect((await run).code).toBe('cancelled');
    expect(milliseconds).toBeLessThan(1000);
    workers.hang = null;
    const again = await client.run(JSON.stringify({ source }), source, 'quality');
    expect(again.report?.source.digest).toBe(digest);
    expect(workers.loads).toBe(2);
  });

  it.each([
    ['memory.nii', 'out_of_memory'],
    ['abort.nii', 'internal'],
  ])('turns a fatal failure (%s) into a typed error and starts a new worker', async (name, code) => {
    const client = start();
    const error = await failureOf(client.openVolume(mockFile(name)));
    expect(error.code).toBe(code);
    expect(workers.spawned).toBe(2);
    expect((await client.openVolume(mockFile('good.nii'))).name).toBe('good.nii');
  });

  it('ends a run whose signal says so, and does nothing once it is closed', async () => {
    const client = start();
    workers.hang = 'remesh';
    const abort = new AbortController();
    const { signal } = abort;
    const run = client.run(JSON.stringify(phantom), phantom.source, 'quality', {
      signal,
      onProgress: (stage) => stage === 'remesh' && abort.abort(),
    });
    expect((await failureOf(run)).code).toBe('cancelled');
    workers.hang = null;
    expect((await client.run(JSON.stringify(phantom), phantom.source, 'quality')).report).toBeDefined();
    const under = client.run(JSON.stringify(phantom), phantom.source, 'quality', {
      onProgress: () => client.close(),
    });
    expect((await failureOf(under)).code).toBe('cancelled');
    const spawned = workers.spawned;
    const after = client.run(JSON.stringify(phantom), phantom.source, 'quality');
    expect((await failureOf(after)).code).toBe('usage');
    expect(workers.spawned).toBe(spawned);
  });

  it('notices a worker that died without a word', async () => {
    const client = start();
    await client.ready;
    await Promise.resolve();
    workers.hang = 'surface';
    const run = failureOf(client.run(JSON.stringify(phantom), phantom.source, 'quality'));
    await new Promise((later) => setTimeout(later, 40));
    workers.released[0]();
    expect((await run).code).toBe('internal');
    workers.hang = null;
    await client.run(JSON.stringify(phantom), phantom.source, 'smooth');
  });

  it('refuses a case whose file has not been dropped', async () => {
    const source = { file: { name: 'absent.nii', sha256: 'a'.repeat(64), url: '' } };
    const error = await failureOf(start().run(JSON.stringify({ source }), source, 'smooth'));
    expect(error.message).toContain('absent.nii');
  });

  it('checks a case without holding its digest against the volume that is open', async () => {
    const client = start();
    await client.openVolume(mockFile('other.nii'));
    const sha256 = 'b'.repeat(64);
    const reply = await client.checkRecipe({ source: { file: { name: 'heart.nii', sha256, url: '' } } });
    expect(reply.recipe.source.file?.sha256).toBe(sha256);
    expect(
      (await failureOf(client.checkRecipe({ source: { file: { name: 'x', sha256: 'zz', url: '' } } }))).code,
    ).toBe('usage');
    expect((await failureOf(client.checkRecipe({ nonsense: 1 }))).message).toContain('nonsense');
  });

  it('checks a case while a run goes on, and leaves the run alone', async () => {
    const client = start();
    workers.hang = 'remesh';
    const run = failureOf(client.run(JSON.stringify(phantom), phantom.source, 'quality'));
    await new Promise((later) => setTimeout(later, 40));
    expect((await client.checkRecipe({ sizing: { edge_mm: 3 } })).recipe.sizing.edge_mm).toBe(3);
    expect((await failureOf(client.checkRecipe({ nonsense: 1 }))).code).toBe('usage');
    expect(client.busy).toBe(true);
    await client.cancel();
    expect((await run).code).toBe('cancelled');
    expect(workers.spawned).toBe(2);
  });

  it('checks a case in its turn where the spare has just become the engine', async () => {
    const client = start();
    workers.hang = 'remesh';
    const run = failureOf(client.run(JSON.stringify(phantom), phantom.source, 'quality'));
    await new Promise((later) => setTimeout(later, 40));
    const check = client.checkRecipe({ sizing: { edge_mm: 3 } });
    void client.cancel();
    workers.hang = null;
    const again = await client.run(JSON.stringify(phantom), phantom.source, 'quality');
    expect(again.report?.recipe.sizing.edge_mm).toBe(2);
    expect((await check).recipe.sizing.edge_mm).toBe(3);
    await run;
  });

  it('exports with the mask that the mesh was made from, though another has taken its name', async () => {
    const client = start();
    const { digest } = await client.openSideVolume('mask', mockFile('paint.nrrd'));
    const masks = [{ name: 'paint.nrrd', sha256: digest, edges: [{ label: 1, edge_mm: 1 }] }];
    const recipe = JSON.stringify({ ...phantom, sizing: { masks } });
    await client.run(recipe, phantom.source, 'quality');
    const other = mockFile('paint.nrrd', 64);
    client.files.keepSide('mask', other, 'e'.repeat(64));
    const later = recipe.replace(digest, 'e'.repeat(64));
    await client.run(later, phantom.source, 'smooth');
    expect(workers.sides.get('paint.nrrd')).toEqual(other.bytes);
    await client.exportMesh(recipe, phantom.source, 'vtu', 'ras', 'heart');
    expect(workers.sides.get('paint.nrrd')).toEqual(mockFile('paint.nrrd').bytes);
  });

  it('forgets the volumes of other cases', async () => {
    const client = start();
    const first = await client.openVolume(mockFile('a.nii'));
    const second = await client.openVolume(mockFile('b.nii', 64));
    client.files.forgetVolumes(second.digest);
    expect(client.files.volume(first.digest)).toBeUndefined();
    expect(client.files.volume(second.digest)?.name).toBe('b.nii');
  });

  describe('simulates on a mesh', () => {
    const recipe = JSON.stringify({ ...phantom, physics: { diffusion: { from: 1 } } });

    /** Frames as they come, until `enough` of them call something. */
    async function meshed(enough = Infinity, then: (client: EngineClient) => void = () => undefined) {
      const client = start();
      await client.run(JSON.stringify(phantom), phantom.source, 'quality');
      const stages: string[] = [];
      const frames: Frame[] = [];
      const simulation = client.simulate(recipe, phantom.source, 'diffusion', {
        onProgress: (stage) => stages.push(stage),
        onFrame: (frame) => void (frames.push(frame) === enough && then(client)),
      });
      return { client, stages, frames, simulation };
    }

    it('and hands over every frame in order, with room for a texture', async () => {
      const { frames, stages, simulation } = await meshed();
      expect((await simulation).summary.name).toBe('diffusion');
      expect(frames.map(({ timeMs }) => timeMs)).toEqual(Array.from({ length: 20 }, (_, i) => 5 * (i + 1)));
      expect(frames[3].values.temperature[0]).toBeCloseTo(0.2, 6);
      expect(frames[3].values.temperature.length).toBe(frames[3].fields[0].count);
      expect(new Set(stages)).toEqual(new Set(['diffusion']));
    });

    it('and is cancelled by word: its worker lives on, and an export runs no stage again', async () => {
      let cancelled: Promise<number> | undefined;
      const run = await meshed(3, (client) => (cancelled = client.cancel()));
      expect((await failureOf(run.simulation)).code).toBe('cancelled');
      expect(await cancelled).toBeLessThan(1000);
      expect(run.frames.length).toBeLessThan(20);
      const again: string[] = [];
      await run.client.exportMesh(
        JSON.stringify(phantom),
        phantom.source,
        'vtu',
        'ras',
        'heart',
        {},
        {
          onProgress: (stage) => again.push(stage),
        },
      );
      expect(again).toEqual([]);
      expect(workers.released.length).toBe(workers.spawned);
      expect(workers.spawned).toBe(2);
    });

    it('and goes on after it was held', async () => {
      const run = await meshed(3, (client) => client.pauseSimulation(true));
      await new Promise((later) => setTimeout(later, 100));
      const held = run.frames.length;
      expect(held).toBeLessThan(20);
      await new Promise((later) => setTimeout(later, 60));
      expect(run.frames.length).toBe(held);
      run.client.pauseSimulation(false);
      await run.simulation;
      expect(run.frames.length).toBe(20);
    });

    it('and hears of a stimulus on its way, which it then has among its own, at its time', async () => {
      const given = { name: 'here', start_ms: 0 } as Stimulus;
      let answered: Promise<Stimulus> | undefined;
      const run = await meshed(3, (client) => (answered = client.stimulate(given)));
      await run.simulation;
      const { start_ms, name } = await answered!;
      expect(name).toBe('here');
      expect(start_ms).toBeGreaterThanOrEqual(15);
      expect(run.frames.length).toBe(20);
      expect((await failureOf(run.client.stimulate(given))).code).toBe('usage');
    });

    it('and is cancelled while it is held', async () => {
      const run = await meshed(3, (client) => client.pauseSimulation(true));
      await new Promise((later) => setTimeout(later, 60));
      await run.client.cancel();
      expect((await failureOf(run.simulation)).code).toBe('cancelled');
      expect(workers.spawned).toBe(2);
    });
  });

  it('hands over fibres and how steep they are, and nothing where none are asked for', async () => {
    const client = start();
    const ask = (physics: object) => client.fibres(JSON.stringify({ ...phantom, physics }), phantom.source);
    const found = await ask({ anatomy: {}, fibres: {} });
    expect(found?.fibre.length).toBe(3 * (found?.helix?.length ?? 0));
    expect([...found!.fibre.subarray(0, 3)]).toEqual([1, 0, 0]);
    // The mock's wall has its base at high y and its outside at high z: the way around it is x.
    expect(found?.helix?.[0]).toBeCloseTo(0, 4);
    expect(await ask({})).toBeNull();
  });

  it('exports the files of a format', async () => {
    const files = await start().exportMesh(JSON.stringify(phantom), phantom.source, 'carp', 'lps', 'heart');
    expect(files.map((one) => one.suffix)).toEqual(['.pts', '.elem', '.lon.txt']);
    expect(new TextDecoder().decode(files[0].bytes)).toBe('carp lps heart');
  });
});
