import type { EngineSetup } from './generation';

/**
 * Whether the page may share memory between threads, and the engine's, which grows to 4 GB, can be had. `?threads=off` in
 * the page's address does without. WebKitGTK calls a page isolated and has no SharedArrayBuffer.
 */
function mayHaveThreads(): boolean {
  if (new URLSearchParams(location.search).get('threads') === 'off') return false;
  if (!crossOriginIsolated || !('SharedArrayBuffer' in globalThis)) return false;
  try {
    new WebAssembly.Memory({ initial: 1, maximum: 65_536, shared: true });
    return true;
  } catch {
    return false;
  }
}

/**
 * Workers, module and locks of the page. The engine's files stand in a folder beside it, which a built page names by
 * their digest (vite.config.ts), those with threads in a folder of that one.
 */
export function browserSetup(engineFolder = import.meta.env.VITE_ENGINE ?? 'engine/'): EngineSetup {
  const files = new URL(engineFolder, document.baseURI);
  const folder = mayHaveThreads() ? new URL('threads/', files) : files;
  const scriptUrl = new URL('voxtet_engine.mjs', folder).href;
  const wasmUrl = new URL('voxtet_engine.wasm', folder).href;
  return {
    scriptUrl,
    spawn: () =>
      new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'voxtet-engine' }),
    async compile() {
      const response = await fetch(wasmUrl);
      if (!response.ok) throw new Error(`${wasmUrl} answered ${response.status}.`);
      return response.headers.get('Content-Type')?.startsWith('application/wasm')
        ? WebAssembly.compileStreaming(response)
        : WebAssembly.compile(await response.arrayBuffer());
    },
    whenReleased(lock, callback) {
      void navigator.locks?.request(lock, callback);
    },
  };
}
