/** The engine's worker in node. */
import { createRequire } from 'node:module';
import { availableParallelism } from 'node:os';
import { parentPort, type MessagePort } from 'node:worker_threads';
import * as Comlink from 'comlink';
import nodeEndpoint from 'comlink/dist/esm/node-adapter';
import { api } from './worker_api';

// What Emscripten's script takes for granted: the first two are there in CommonJS only, the last since node 21.
Object.assign(globalThis, { require: createRequire(import.meta.url), __dirname: '' });
if (!globalThis.navigator)
  Object.assign(globalThis, { navigator: { hardwareConcurrency: availableParallelism() } });

Comlink.expose(api, nodeEndpoint(parentPort as MessagePort));
