import type { EngineSetup } from './client';

/** Workers, module and locks of the page. The engine's two files stand beside it, in engine/. */
export function browserSetup(): EngineSetup {
  const scriptUrl = new URL('engine/voxtet_engine.mjs', document.baseURI).href;
  const wasmUrl = new URL('engine/voxtet_engine.wasm', document.baseURI).href;
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
