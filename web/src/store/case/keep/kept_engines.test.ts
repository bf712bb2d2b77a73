import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { EngineClient } from '../../../engine/client';
import { Workers } from '../../../engine/testing/workers';

const kept = {
  mock: { folder: 'assets/engine-00000001/', interface: 2 },
  other: { folder: 'assets/engine-00000002/', interface: 2 },
  strange: { folder: 'https://elsewhere.org/engine-00000002/', interface: 2 },
  ancient: { folder: 'assets/engine-00000003/', interface: 1 },
};

let workers: Workers;
let made: string[];
let engines: typeof import('./kept_engines');

beforeEach(async () => {
  vi.resetModules();
  vi.stubGlobal('document', { baseURI: 'http://localhost/app/' });
  vi.stubGlobal('fetch', async (url: URL) => {
    expect(url.href).toBe('http://localhost/app/engines.json');
    return { ok: true, json: async () => kept };
  });
  made = [];
  workers = new Workers();
  engines = await import('./kept_engines');
  await engines.startOwn(new EngineClient(workers.setup()), (folder, files) => {
    made.push(folder);
    return new EngineClient(workers.setup(), files);
  });
});
afterEach(() => {
  workers.end();
  vi.unstubAllGlobals();
});

describe('engines that are kept', () => {
  it("are no matter where a case promises nothing, or was made with the page's own", async () => {
    expect(await engines.engineOf(undefined)).toBe(engines.ownEngine());
    expect(await engines.engineOf('mock')).toBe(engines.ownEngine());
    expect(made).toEqual([]);
  });

  it('are taken from our own folders only, and where the page can drive them', async () => {
    expect(await engines.folderOf('other')).toBe('assets/engine-00000002/');
    expect(await engines.folderOf('strange')).toBeNull();
    expect(await engines.folderOf('ancient')).toBeNull();
    expect(await engines.folderOf('0.0.1+0123')).toBeNull();
  });

  it('that turn out to be another version are not used', async () => {
    // The engine of the folder says that it is "mock".
    expect(await engines.engineOf('other')).toBe(engines.ownEngine());
    expect(made).toEqual(['assets/engine-00000002/']);
    expect(engines.keptInUse.value).toBeNull();
  });
});
