import { MessageChannel } from 'node:worker_threads';
import * as Comlink from 'comlink';
import type { EngineSetup, WorkerLike } from '../generation';
import type { EngineApi, StageName, VolumeFile } from '../contract';
import { createSessionApi, transferables } from '../session_api';
import createVoxtet from './mock_engine.mjs';

const emptyModule = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]);

/** Message ports as workers; each serves the mock engine, and can hang, or die without a word. */
export class Workers {
  spawned = 0;
  loads = 0;
  sideLoads = 0;
  /** Bytes of the masks and images that were handed over last, by name. */
  sides = new Map<string, Uint8Array>();
  hang: StageName | 'forecast' | null = null;
  /** Progress arrives once more after its stage has been answered. */
  late = false;
  released: (() => void)[] = [];
  private ports: { close(): void }[] = [];

  setup(): EngineSetup {
    return {
      scripts: { engine: 'mock' },
      compile: () => WebAssembly.compile(emptyModule),
      spawn: () => this.spawn(),
      whenReleased: (_, callback) => void this.released.push(callback),
    };
  }

  private spawn(): WorkerLike {
    this.spawned++;
    const { port1, port2 } = new MessageChannel();
    this.ports.push(port1, port2);
    let session: ReturnType<typeof createSessionApi>;
    const api: EngineApi = {
      start: async () => {
        const engine = await createVoxtet();
        const instance = new engine.Session();
        session = createSessionApi(instance);
        return { schema: JSON.parse(instance.schema()), defaults: JSON.parse(instance.defaults()) };
      },
      loadVolume: (file, source) => {
        this.loads++;
        return session.loadVolume(file, source);
      },
      loadSideVolume: (kind, file) => {
        this.sideLoads++;
        this.sides.set(file.name, file.bytes);
        return session.loadSideVolume(kind, file);
      },
      setRecipe: (json) => session.setRecipe(json),
      inlineCase: () => session.inlineCase(),
      run: (stage, onProgress) => {
        if (this.late && stage !== 'fibres') setTimeout(() => onProgress(stage, 1), 10);
        return stage === this.hang ? (new Promise(() => undefined) as never) : session.run(stage, onProgress);
      },
      simulate: (stage, onProgress, onFrame) => session.simulate(stage, onProgress, onFrame),
      found: (stage) => session.found(stage),
      fibres: () => session.fibres(),
      stimulate: (json) => session.stimulate(json),
      pauseSimulation: (paused) => session.pauseSimulation(paused),
      endSimulation: () => session.endSimulation(),
      values: (file, onFrame) => session.values(file, onFrame),
      forecast: (elements) =>
        this.hang === 'forecast' ? (new Promise(() => undefined) as never) : session.forecast(elements),
      arrays: (stage) => {
        const reply = session.arrays(stage);
        return Comlink.transfer(reply, transferables(reply));
      },
      exportMesh: (format, space, name, measures, order) =>
        session.exportMesh(format, space, name, measures, order),
      report: () => session.report(),
    };
    Comlink.expose(api, port2 as unknown as Comlink.Endpoint);
    port2.start();
    return Object.assign(port1, { terminate: () => port1.close() }) as unknown as WorkerLike;
  }

  end(): void {
    for (const port of this.ports) port.close();
  }
}

/** A file that the mock engine reads; other sizes have other digests. */
export const mockFile = (name: string, size = 32): VolumeFile => ({
  name,
  bytes: new Uint8Array(size).fill(7),
  siblings: {},
});
