import type { EngineSetup } from './generation';

/** Where the engine's files are: its script, its module, and the script of its threads where it has a name of its own. */
export interface EngineFiles {
  script: URL;
  module: URL;
  thread?: URL;
}

/**
 * Whether the page may share memory between threads, and the engine's, which grows to 4 GB, can be had. WebKitGTK calls a
 * page isolated and has no SharedArrayBuffer.
 */
export function mayHaveThreads(): boolean {
  if (!crossOriginIsolated || !('SharedArrayBuffer' in globalThis)) return false;
  try {
    new WebAssembly.Memory({ initial: 1, maximum: 65_536, shared: true });
    return true;
  } catch {
    return false;
  }
}

/** Workers, module and locks of a page. */
export function browserSetup({ script, module, thread }: EngineFiles, spawn: () => Worker): EngineSetup {
  return {
    scripts: { engine: script.href, thread: thread?.href },
    spawn,
    async compile() {
      const response = await fetch(module);
      if (!response.ok) throw new Error(`${module} answered ${response.status}.`);
      return response.headers.get('Content-Type')?.startsWith('application/wasm')
        ? WebAssembly.compileStreaming(response)
        : WebAssembly.compile(await response.arrayBuffer());
    },
    whenReleased(lock, callback) {
      void navigator.locks?.request(lock, callback);
    },
  };
}
