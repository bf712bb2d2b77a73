import { browserSetup, mayHaveThreads } from '../engine/browser_setup';
import type { MesherOptions } from './common';
import { Mesher } from './mesher';

export * from './common';

// Bundlers find the files by these very words, and give them other names.
const one = {
  script: new URL('../engine/voxtet_engine.mjs', import.meta.url),
  module: new URL('../engine/voxtet_engine.wasm', import.meta.url),
};
const several = {
  script: new URL('../engine/threads/voxtet_engine.mjs', import.meta.url),
  module: new URL('../engine/threads/voxtet_engine.wasm', import.meta.url),
  thread: new URL('../engine/threads/voxtet_engine.worker.js?no-inline', import.meta.url),
};

/** Starts the engine in a worker of its own. */
export function createMesher({ threads = true }: MesherOptions = {}): Promise<Mesher> {
  const spawn = () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'voxtet' });
  return Mesher.start(browserSetup(threads && mayHaveThreads() ? several : one, spawn));
}
