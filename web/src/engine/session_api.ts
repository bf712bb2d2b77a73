import { withRoom } from '../geometry/rows';
import { smoothNormals } from '../geometry/smooth_normals';
import { tetFaces } from '../geometry/tet_faces';
import { tetNeighbours } from '../geometry/tet_neighbours';
import type {
  EngineApi,
  ErrorInfo,
  ExportedFile,
  LookedUpArray,
  Reply,
  StageName,
  SurfaceArrays,
  TetArrays,
} from './contract';
import { stageNames, tetMeasures } from './contract';

type View = Float32Array | Uint32Array | Uint16Array;
/** A view's copy, or what the worker made of some. */
type Held = View | Int32Array | Float64Array;

/** The embind class, as its users see it. */
export interface Session {
  schema(): string;
  defaults(): string;
  loadVolume(name: string, bytes: Uint8Array, siblings: Record<string, Uint8Array>): string;
  loadSideVolume(kind: string, name: string, bytes: Uint8Array, siblings: Record<string, Uint8Array>): string;
  setRecipe(json: string): string;
  run(stage: string, onProgress: (stage: string, fraction: number) => void): string;
  forecast(elements: number): string;
  view(stage: string, array: string): View | undefined;
  exportMesh(format: string, space: string, name: string): string;
  exportBytes(index: number): Uint8Array;
  report(): string;
  delete(): void;
}

export interface EngineModule {
  Session: new () => Session;
}

const arrayNames: Record<StageName, readonly string[]> = {
  volume: ['labels'],
  surface: ['points', 'triangles', 'sides'],
  smooth: ['points', 'triangles', 'sides'],
  sizing: ['h_mm', 'thickness_mm'],
  remesh: ['points', 'triangles', 'sides'],
  optimise: ['points', 'tets', 'labels'],
  quality: [...tetMeasures, 'distance_mm', 'layer', 'layers_across'],
};

function lookedUpArrays(labels: readonly number[]): LookedUpArray[] {
  if (labels.length === 0) return [];
  return ['centroid_label', 'majority_label', ...labels.map((label) => `fraction_${label}` as const)];
}

/** Share of the time until there are good tetrahedra that filling the surface takes. */
const fillingShare = 0.7;

/** Progress as that of a stage that the app shows. */
function asShown(name: string, fraction: number): [string, number] {
  if (name === 'tetra') return ['optimise', fillingShare * fraction];
  if (name === 'optimise') return ['optimise', fillingShare + (1 - fillingShare) * fraction];
  return [name, fraction];
}

function isShownStage(name: string): name is StageName {
  return (stageNames as readonly string[]).includes(name);
}

/** Messages closer together than this tell a person nothing. */
const progressIntervalMs = 40;

function describeFailure(failure: unknown, stage: string): ErrorInfo {
  const text = failure instanceof Error ? `${failure.name}: ${failure.message}` : String(failure);
  const memory =
    /out of memory|\bOOM\b|bad_alloc|enlarge memory|allocation failed|Invalid typed array length/i;
  const exhausted = memory.test(text);
  return {
    code: exhausted ? 'out_of_memory' : 'internal',
    stage,
    message: exhausted
      ? 'The engine ran out of memory. Larger edge lengths or fewer labels need less.'
      : `The engine stopped unexpectedly (${text}).`,
    fatal: true,
  };
}

function guarded<T>(stage: string, body: () => Reply<T>): Reply<T> {
  try {
    return body();
  } catch (failure) {
    return { ok: false, error: describeFailure(failure, stage) };
  }
}

function copied(view: View): View {
  return view.slice() as View;
}

/** One session as plain values: texts parsed, views copied once, failures turned into typed errors. */
export function createSessionApi(session: Session): Omit<EngineApi, 'start'> {
  let lookedUp: readonly number[] = [];
  return {
    loadVolume: (file) =>
      guarded('volume', () => JSON.parse(session.loadVolume(file.name, file.bytes, file.siblings))),

    loadSideVolume: (kind, { name, bytes, siblings }) =>
      guarded('sizing', () => JSON.parse(session.loadSideVolume(kind, name, bytes, siblings))),

    setRecipe: (json) =>
      guarded('recipe', () => {
        const reply = JSON.parse(session.setRecipe(json)) as ReturnType<EngineApi['setRecipe']>;
        if (reply.ok) lookedUp = reply.value.recipe.lookup.labels;
        return reply;
      }),

    run: (stage, onProgress) => {
      let current: string = stage;
      let lastTime = 0;
      return guarded(stage, () => {
        const reply = session.run(stage, (engineStage, engineFraction) => {
          const [name, fraction] = asShown(engineStage, engineFraction);
          if (!isShownStage(name)) return;
          const now = performance.now();
          if (name === current && fraction < 1 && now - lastTime < progressIntervalMs) return;
          current = name;
          lastTime = now;
          onProgress(name, fraction);
        });
        return JSON.parse(reply);
      });
    },

    forecast: (elements) => guarded('forecast', () => JSON.parse(session.forecast(elements))),

    arrays: (stage) =>
      guarded(stage, () => {
        const arrays: Record<string, Held> = {};
        const keep = (from: string, names: readonly string[]) => {
          for (const name of names) {
            const view = session.view(from, name);
            if (view) arrays[name] = copied(view);
          }
        };
        keep(stage, arrayNames[stage]);
        if (stage === 'smooth' && arrays.triangles)
          arrays.normals = smoothNormals(arrays as unknown as SurfaceArrays);
        if (stage === 'quality') keep('lookup', lookedUpArrays(lookedUp));
        if (stage === 'optimise' && arrays.tets) {
          arrays.neighbours = tetNeighbours(arrays.tets as Uint32Array, arrays.points.length / 3);
          Object.assign(arrays, tetFaces(arrays as unknown as TetArrays));
          for (const name of ['tets', 'neighbours', 'faces', 'centres'])
            arrays[name] = withRoom(arrays[name] as Uint32Array<ArrayBuffer>);
        }
        return { ok: true, value: arrays as never };
      }),

    exportMesh: (format, space, name) =>
      guarded('export', () => {
        const reply = JSON.parse(session.exportMesh(format, space, name)) as Reply<{
          files: { suffix: string; bytes: number }[];
        }>;
        if (!reply.ok) return reply;
        const files: ExportedFile[] = reply.value.files.map(({ suffix }, index) => ({
          suffix,
          bytes: new Uint8Array(session.exportBytes(index)),
        }));
        return { ok: true, value: files };
      }),

    report: () => guarded('quality', () => ({ ok: true, value: JSON.parse(session.report()) })),
  };
}

/** The buffers that a reply may hand over instead of copying. */
export function transferables(reply: Reply<unknown>): Transferable[] {
  if (!reply.ok || typeof reply.value !== 'object' || reply.value === null) return [];
  const buffers = new Set<ArrayBuffer>();
  for (const entry of Object.values(reply.value) as unknown[]) {
    const array = ArrayBuffer.isView(entry) ? entry : (entry as { bytes?: unknown } | null)?.bytes;
    if (ArrayBuffer.isView(array)) buffers.add(array.buffer as ArrayBuffer);
  }
  return [...buffers];
}
