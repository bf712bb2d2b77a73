import { browserSetup, mayHaveThreads } from './browser_setup';
import type { EngineSetup } from './generation';

/**
 * The engine of the app: its files stand in a folder beside the page, which a built page names by their digest
 * (vite.config.ts), those with threads in a folder of that one. `?threads=off` in its address does without.
 */
export function appSetup(engineFolder = import.meta.env.VITE_ENGINE ?? 'engine/'): EngineSetup {
  const files = new URL(engineFolder, document.baseURI);
  const off = new URLSearchParams(location.search).get('threads') === 'off';
  const folder = !off && mayHaveThreads() ? new URL('threads/', files) : files;
  return browserSetup(
    { script: new URL('voxtet_engine.mjs', folder), module: new URL('voxtet_engine.wasm', folder) },
    () => new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'voxtet-engine' }),
  );
}
