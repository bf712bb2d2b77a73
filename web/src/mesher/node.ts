import { nodeSetup } from '../engine/node_setup';
import type { MesherOptions } from './common';
import { Mesher } from './mesher';

export * from './common';

/** Starts the engine in a worker thread. */
export function createMesher({ threads = true }: MesherOptions = {}): Promise<Mesher> {
  const folder = new URL(threads ? '../engine/threads/' : '../engine/', import.meta.url);
  const files = {
    script: new URL('voxtet_engine.mjs', folder),
    module: new URL('voxtet_engine.wasm', folder),
  };
  return Mesher.start(nodeSetup(files, new URL('./node_worker.js', import.meta.url)));
}
