import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { EngineClient } from '../../engine/client';
import type { Expected } from '../../engine/contract';
import { mockFile, Workers } from '../../engine/testing/workers';
import { acceptOffer, offerCase, openPhantom, startEngine } from './open_case';
import { shareCase } from './exchange';
import { awaitedFile, volume } from './input';
import { dropFiles, openFiles, openSizeFiles } from './open_files';
import { editRecipe, recipe, undo } from './recipe';
import { dismiss, notices } from '../notices';
import { expectation, report, upToDate, verdict } from '../run/report';
import { activity, stages } from '../run/stages';
import { cancelRun, runAll, runTo } from '../run/run_stages';
import { awaitedSides } from './side_files';

const fileOf = (name: string, size = 32) => new File([mockFile(name, size).bytes], name);
const later = (ms = 40) => new Promise((done) => setTimeout(done, ms));
const atRest = () => vi.waitFor(() => expect(activity.value).toBe('idle'), 5000);
const edge = (edge_mm: number) => editRecipe('Edge', (draft) => void (draft.sizing.edge_mm = edge_mm));

let workers: Workers;
let client: EngineClient;

beforeEach(async () => {
  vi.stubGlobal('history', { replaceState: () => undefined });
  vi.stubGlobal('location', { href: 'http://localhost/' });
  workers = new Workers();
  client = new EngineClient(workers.setup());
  await startEngine(client);
  for (const { id } of notices.value) dismiss(id);
  awaitedFile.value = null;
  volume.value = null;
});
afterEach(async () => {
  workers.hang = null;
  await cancelRun();
  workers.end();
  vi.unstubAllGlobals();
});

/** A case of a file, with a mask where one is named, as a link would bring it. */
async function openLinked(names: { mask?: string; expected?: object }): Promise<string> {
  const { digest } = await client.openVolume(mockFile('heart.nii'));
  client.files.forgetVolumes();
  const masks = names.mask ? [{ name: names.mask, sha256: '', edges: [{ label: 1, edge_mm: 1 }] }] : [];
  const { expected } = names;
  await offerCase({
    source: { file: { name: 'heart.nii', sha256: digest } },
    sizing: { masks },
    ...(expected && { expected }),
  });
  acceptOffer(false);
  return digest;
}

describe('the promise of a link', () => {
  const expected = { engine: 'mock', digest: 'd'.repeat(64), tets: 5 };

  it('is for the volume, under whatever name it is dropped in', async () => {
    await openLinked({ expected });
    await dropFiles([fileOf('heart (1).nii')]);
    await atRest();
    await runAll();
    expect(recipe.value?.source.file?.name).toBe('heart (1).nii');
    expect(verdict.value?.mesh).toBe('differs');
  });

  it('of an older engine is no promise of this one, whose mesh may be another', async () => {
    await openLinked({ expected: { ...expected, engine: '0.1.0' } });
    await dropFiles([fileOf('heart.nii')]);
    await atRest();
    await runAll();
    expect(verdict.value?.mesh).toBe('other_engine');
    expect(verdict.value?.rows[0]).toMatchObject({ expected: '0.1.0', found: 'mock' });
    // What is handed on names the engine that made it.
    const { minimal } = await shareCase();
    expect(minimal.expected).toMatchObject({ engine: 'mock', digest: report.value?.digest });
  });

  it('of an older engine is kept where the bytes are the same', async () => {
    await openPhantom({ kind: 'sphere' });
    await atRest();
    await runAll();
    const { minimal } = await shareCase();
    await offerCase({ ...minimal, expected: { ...(minimal.expected as Expected), engine: '0.1.0' } });
    acceptOffer(true);
    await vi.waitFor(() => expect(verdict.value?.mesh).toBe('reproduced'), 5000);
  });

  it('is for its recipe, not for what comes of it', async () => {
    await openLinked({ expected });
    await dropFiles([fileOf('heart.nii')]);
    await atRest();
    edge(3);
    await runAll();
    expect(expectation.value?.recipe.sizing.edge_mm).toBe(2);
    expect(verdict.value).toBeNull();
    undo();
    await runAll();
    expect(verdict.value).not.toBeNull();
  });
});

describe('files', () => {
  it('of an awaited case are each opened for what they are', async () => {
    await openLinked({ mask: 'scar.nii' });
    await dropFiles([fileOf('heart.nii'), fileOf('scar.nii', 64), fileOf('other.nii', 48)]);
    await atRest();
    expect(awaitedFile.value).toBeNull();
    expect(awaitedSides.value).toEqual([]);
    expect(recipe.value?.sizing.masks.map(({ name }) => name)).toEqual(['scar.nii']);
    expect(notices.value.map(({ text }) => text).join()).toContain('left out: other.nii');
  });

  it('that are not the awaited one can begin a case of their own', async () => {
    const digest = await openLinked({});
    await dropFiles([fileOf('liver.nii', 64)]);
    const notice = notices.value.find(({ title }) => title === 'This is not the expected volume');
    expect(recipe.value?.source.file?.sha256).toBe(digest);
    notice?.way?.go();
    await atRest();
    expect(recipe.value?.source.file?.name).toBe('liver.nii');
    expect(awaitedFile.value).toBeNull();
  });

  it('that were overtaken while they were read do not end what came after', async () => {
    const slow = fileOf('large.nii', 64);
    let read: (bytes: ArrayBuffer) => void = () => undefined;
    slow.arrayBuffer = () => new Promise((done) => (read = done));
    const first = openFiles([slow]);
    await later();
    workers.hang = 'surface';
    await openFiles([fileOf('small.nii')]);
    await vi.waitFor(() => expect(stages.value.surface.state).toBe('running'), 5000);
    const { spawned } = workers;
    read(new ArrayBuffer(64));
    await first;
    expect(recipe.value?.source.file?.name).toBe('small.nii');
    expect(activity.value).toBe('preview');
    expect(workers.spawned).toBe(spawned);
  });

  it.each(['Open file', 'mask'])('that end a run leave no stage under way (%s)', async (kind) => {
    await openFiles([fileOf('heart.nii')]);
    await atRest();
    workers.hang = 'remesh';
    const run = runAll();
    await vi.waitFor(() => expect(stages.value.remesh.state).toBe('running'), 5000);
    const bad = [fileOf('cut.nii', 3)];
    await (kind === 'mask' ? openSizeFiles('mask', [fileOf('paint.nii')]) : openFiles(bad));
    await run;
    expect(stages.value.remesh.state).toBe('waiting');
    expect(recipe.value?.source.file?.name).toBe('heart.nii');
  });

  it('that cannot be read at all are told', async () => {
    const gone = new File([], 'case.json');
    gone.text = () => Promise.reject(new Error('The file is gone.'));
    await openFiles([gone]);
    expect(notices.value.at(-1)?.text).toBe('The file is gone.');
  });
});

describe('a case', () => {
  it('that is chosen during a run is opened at once', async () => {
    await openPhantom({ kind: 'torus' });
    await atRest();
    workers.hang = 'remesh';
    const run = runAll();
    await vi.waitFor(() => expect(stages.value.remesh.state).toBe('running'), 5000);
    workers.hang = null;
    await openPhantom({ kind: 'sphere' });
    expect(recipe.value?.source.phantom?.kind).toBe('sphere');
    await run;
    await atRest();
    expect(report.value).toBeNull();
  });

  it('that waits for its file ends the run of the one before', async () => {
    await openPhantom({ kind: 'torus' });
    await atRest();
    workers.hang = 'remesh';
    const run = runAll();
    await vi.waitFor(() => expect(stages.value.remesh.state).toBe('running'), 5000);
    await offerCase({ source: { file: { name: 'heart.nii', sha256: '' } } });
    expect(activity.value).toBe('run');
    acceptOffer(false);
    expect(activity.value).toBe('idle');
    expect(awaitedFile.value?.name).toBe('heart.nii');
    await run;
    expect(stages.value.smooth.state).toBe('waiting');
  });

  it('whose preview is cancelled is not run, though it was to be', async () => {
    workers.hang = 'surface';
    await offerCase({ source: { phantom: { kind: 'sphere' } } });
    acceptOffer(true);
    await vi.waitFor(() => expect(volume.value).not.toBeNull(), 5000);
    await cancelRun();
    workers.hang = null;
    await later(150);
    expect(activity.value).toBe('idle');
    expect(stages.value.remesh.state).toBe('waiting');
  });

  it('runs where it was to be', async () => {
    await offerCase({ source: { phantom: { kind: 'sphere' } } });
    acceptOffer(true);
    await vi.waitFor(() => expect(report.value).not.toBeNull(), 5000);
  });

  it('has no evidence of another mesh than the one that is shown', async () => {
    await openPhantom({ kind: 'sphere' });
    await atRest();
    await runAll();
    expect(report.value).not.toBeNull();
    edge(3);
    await runTo('optimise');
    expect(report.value).toBeNull();
    undo();
    expect(upToDate.value).toBe(false);
  });

  it('stays done where a run of it is cancelled before anything has changed', async () => {
    await openPhantom({ kind: 'sphere' });
    await atRest();
    await runAll();
    workers.hang = 'volume';
    const run = runAll();
    await later();
    await cancelRun();
    await run;
    expect(Object.values(stages.value).map(({ state }) => state)).toEqual(Array(7).fill('done'));
  });

  it('is the same in whatever order its fields stand', async () => {
    await openPhantom({ kind: 'sphere' });
    await atRest();
    const size = (sizes: object[]) =>
      editRecipe('Size', (draft) => void (draft.sizing.labels = sizes as typeof draft.sizing.labels));
    size([{ edge_mm: 1, label: 1 }]);
    await runAll();
    size([]);
    size([{ label: 1, edge_mm: 1 }]);
    expect(upToDate.value).toBe(true);
  });
});
