import { readFile } from 'node:fs/promises';
import { Worker } from 'node:worker_threads';
import nodeEndpoint from 'comlink/dist/esm/node-adapter';
import type { EngineFiles } from './browser_setup';
import type { EngineSetup, WorkerLike } from './generation';

/** A worker of node as the client knows them: its end is an error, unless the client has ended it. */
function workerLike(worker: Worker): WorkerLike {
  const endpoint = nodeEndpoint(worker);
  return {
    ...endpoint,
    addEventListener(type, listener) {
      if (type === 'message') return endpoint.addEventListener(type, listener);
      const tell = (message: string) => (listener as (event: object) => void)({ message });
      worker.on('error', (error) => tell(String(error)));
      worker.on('exit', (code) => tell(`it ended with code ${code}`));
    },
    terminate: () => void worker.terminate(),
  };
}

/** Worker threads and module of node. */
export function nodeSetup({ script, module }: EngineFiles, workerScript: URL): EngineSetup {
  return {
    scripts: { engine: script.href },
    spawn: () => workerLike(new Worker(workerScript, { name: 'voxtet-engine' })),
    compile: async () => WebAssembly.compile(await readFile(module)),
    // Its worker says itself that it has ended.
    whenReleased: () => undefined,
  };
}
