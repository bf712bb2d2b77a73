/** What the engine's worker answers, in a page and in node. */
import * as Comlink from 'comlink';
import type { EngineApi, EngineInfo, EngineScripts, Frame } from './contract';
import { createSessionApi, transferables, type EngineModule } from './session_api';

type CreateEngine = (options: {
  mainScriptUrlOrBlob: string;
  locateFile?: (name: string) => string;
  instantiateWasm: (
    imports: WebAssembly.Imports,
    done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void,
  ) => object;
}) => Promise<EngineModule>;

let session: Omit<EngineApi, 'start'> | undefined;

function current(): Omit<EngineApi, 'start'> {
  if (!session) throw new Error('The engine has not been started.');
  return session;
}

/** Held for the worker's life: whoever waits for the same lock learns at once that the worker is gone. */
function holdLifeLock(name: string): Promise<void> {
  if (!navigator.locks) return Promise.resolve();
  return new Promise((held) => {
    void navigator.locks.request(name, () => {
      held();
      return new Promise<never>(() => undefined);
    });
  });
}

/** Emscripten starts threads as classic workers; what a development server makes of their script is a module. */
function startThreadsAsModules(): void {
  globalThis.Worker = class extends Worker {
    constructor(script: string | URL) {
      super(script, { type: 'module', name: 'voxtet-thread' });
    }
  };
}

async function start(
  module: WebAssembly.Module,
  { engine: scriptUrl, thread }: EngineScripts,
  lock: string,
): Promise<EngineInfo> {
  const locked = holdLifeLock(lock);
  if (thread) startThreadsAsModules();
  const { default: createEngine } = (await import(/* @vite-ignore */ scriptUrl)) as { default: CreateEngine };
  const engine = await createEngine({
    mainScriptUrlOrBlob: scriptUrl,
    ...(thread && { locateFile: () => thread }),
    instantiateWasm(imports, done) {
      void WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
  });
  const instance = new engine.Session();
  session = createSessionApi(instance);
  await locked;
  return { schema: JSON.parse(instance.schema()), defaults: JSON.parse(instance.defaults()) };
}

function handOver<T extends object>(reply: T): T {
  return Comlink.transfer(reply, transferables(reply as never));
}

/** Callbacks are ports of their own, which both sides would keep open after the run. */
function releasing<T>(run: Promise<T>, ...callbacks: unknown[]): Promise<T> {
  return run.finally(() => {
    for (const callback of callbacks) (callback as Comlink.ProxyMethods)[Comlink.releaseProxy]();
  });
}

/** Hands frames to a callback of the page, which gets their buffers. */
function handing(onFrame: (frame: Frame) => Promise<void>): typeof onFrame {
  return (frame) =>
    onFrame(
      Comlink.transfer(
        frame,
        [...Object.values(frame.values), ...(frame.moves ? [frame.moves] : [])].map(({ buffer }) => buffer),
      ),
    );
}

export const api: EngineApi = {
  start,
  loadVolume: (file, source) => current().loadVolume(file, source),
  loadSideVolume: (kind, file) => current().loadSideVolume(kind, file),
  setRecipe: (json) => current().setRecipe(json),
  inlineCase: () => current().inlineCase(),
  run: (stage, onProgress) => releasing(current().run(stage, onProgress), onProgress),
  simulate: (stage, onProgress, onFrame) =>
    releasing(current().simulate(stage, onProgress, handing(onFrame)), onProgress, onFrame),
  found: (stage) => handOver(current().found(stage)),
  fibres: () => handOver(current().fibres()),
  stimulate: (json) => current().stimulate(json),
  pauseSimulation: (paused) => current().pauseSimulation(paused),
  endSimulation: () => current().endSimulation(),
  values: (file, onFrame) => releasing(current().values(file, handing(onFrame)), onFrame),
  forecast: (elements) => current().forecast(elements),
  arrays: (stage) => handOver(current().arrays(stage)),
  exportMesh: (format, space, name, measures, order) =>
    handOver(current().exportMesh(format, space, name, measures, order)),
  report: () => current().report(),
};
