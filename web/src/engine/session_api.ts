import { helixAngles } from '../geometry/helix_angles';
import { withNone, withRoom } from '../geometry/rows';
import { smoothNormals } from '../geometry/smooth_normals';
import { tetFaces } from '../geometry/tet_faces';
import { tetNeighbours } from '../geometry/tet_neighbours';
import type {
  ElementOrder,
  EngineApi,
  FibreArrays,
  FieldInfo,
  ExportedFile,
  Frame,
  Labels,
  Reply,
  StageArrays,
  StageName,
  SurfaceArrays,
  TetArrays,
  VolumeFile,
} from './contract';
import { noValue, stageNames } from './contract';
import { guarded } from './failures';
import { frameOf, PartedRuns, type Snapshot } from './parts';

type View = Float32Array | Uint32Array | Uint16Array;
/** A view's copy, or what the worker made of some. */
type Held = View | Uint8Array | Int32Array | Float64Array;

/** The embind class, as its users see it. */
export interface Session {
  schema(): string;
  defaults(): string;
  loadVolume(name: string, bytes: Uint8Array, siblings: Record<string, Uint8Array>, source: string): string;
  loadSideVolume(kind: string, name: string, bytes: Uint8Array, siblings: Record<string, Uint8Array>): string;
  setRecipe(json: string): string;
  inlineCase(): string;
  begin(stage: string): string;
  advance(budgetMs: number, onProgress: (stage: string, fraction: number) => void): string;
  end(): void;
  forecast(elements: number): string;
  describe(stage: string): string;
  array(stage: string, name: string): View | undefined;
  stimulate(json: string): string;
  takeSnapshot(): string;
  snapshotArray(name: string): View | undefined;
  openValues(name: string, bytes: Uint8Array): string;
  valuesFrame(frame: number): string;
  closeValues(): void;
  exportMesh(format: string, space: string, name: string, measures: boolean, order: ElementOrder): string;
  exportBytes(index: number): Uint8Array;
  report(): string;
  delete(): void;
}

export interface EngineModule {
  Session: new () => Session;
}

/** Geometry, by name; a stage that is not here has fields only. */
const arrayNames: Partial<Record<StageName, readonly string[]>> = {
  surface: ['points', 'triangles', 'sides'],
  smooth: ['points', 'triangles', 'sides'],
  sizing: ['h_mm'],
  remesh: ['points', 'triangles', 'sides'],
  optimise: ['points', 'tets', 'labels'],
};

/** What was transferred stands with the evidence. */
const stagesOfEvidence = ['quality', 'transfer'];

/** What a simulation is made from can be looked at beside what it found. */
const stagesBefore = ['anatomy', 'tissue'];

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

function copied(view: View): View {
  return view.slice() as View;
}

/** The page holds the image for as long as the case is open: in bytes where its labels fit. */
function copiedLabels(view: Uint16Array): Labels {
  for (let i = 0; i < view.length; i++) if (view[i] > 255) return view.slice();
  return new Uint8Array(view);
}

/** Numbers, one for each element; `none` stands for those that are missing. */
function fieldsOf(session: Session, stages: readonly string[], none: number): StageArrays['quality'] {
  const fields: FieldInfo[] = [];
  const values: Record<string, Float32Array> = {};
  for (const stage of stages) {
    const reply = JSON.parse(session.describe(stage)) as Reply<FieldInfo[]>;
    for (const field of reply.ok ? reply.value : []) {
      const view = session.array(stage, field.name) as Float32Array | undefined;
      if (!view || field.components !== 1) continue;
      fields.push(field);
      const gaps = none === noValue || field.scale === 'whole' || field.on === 'points';
      values[field.name] = gaps ? withNone(view, none) : (copied(view) as Float32Array);
    }
  }
  return { fields, values };
}

/** Hands over the frames of a file of values one by one: there may be more than memory holds. */
async function eachFrame(
  session: Session,
  { name, bytes }: VolumeFile,
  onFrame: (frame: Frame) => Promise<void>,
): Promise<Reply<null>> {
  const opened = guarded(
    'values',
    () => JSON.parse(session.openValues(name, bytes)) as Reply<{ frames: number }>,
  );
  if (!opened.ok) return opened;
  for (let k = 0; k < opened.value.frames; k++) {
    const told = guarded('values', () => JSON.parse(session.valuesFrame(k)) as Reply<Snapshot>);
    if (!told.ok) return told;
    await onFrame(frameOf(session, told.value));
  }
  session.closeValues();
  return { ok: true, value: null };
}

function fibresOf(session: Session): FibreArrays | null {
  const [fibre, depth, height, tets, points] = [
    ['fibres', 'fibre'],
    ['anatomy', 'transmural'],
    ['anatomy', 'apicobasal'],
    ['optimise', 'tets'],
    ['optimise', 'points'],
  ].map(([stage, name]) => session.array(stage, name)) as (Float32Array | undefined)[];
  if (!fibre?.length || !tets || !points) return null;
  const mesh = { points, tets: tets as unknown as Uint32Array };
  const known = depth?.length && height?.length;
  return {
    fibre: copied(fibre) as Float32Array,
    helix: known ? withNone(helixAngles(mesh, fibre, depth, height), noValue) : null,
  };
}

/** One session as plain values: texts parsed, views copied once, failures turned into typed errors. */
export function createSessionApi(session: Session): Omit<EngineApi, 'start'> {
  const runs = new PartedRuns(session);
  return {
    loadVolume: ({ name, bytes, siblings }, source) =>
      guarded('volume', () => JSON.parse(session.loadVolume(name, bytes, siblings, source))),

    loadSideVolume: (kind, { name, bytes, siblings }) =>
      guarded('sizing', () => JSON.parse(session.loadSideVolume(kind, name, bytes, siblings))),

    inlineCase: () => guarded('volume', () => JSON.parse(session.inlineCase())),
    setRecipe: (json) =>
      guarded('recipe', () => {
        return JSON.parse(session.setRecipe(json)) as ReturnType<EngineApi['setRecipe']>;
      }),

    run: (stage, onProgress) =>
      runs.run(stage, (engineStage, engineFraction) => {
        const [name, fraction] = asShown(engineStage, engineFraction);
        if (isShownStage(name)) onProgress(name, fraction);
      }),

    simulate: (stage, onProgress, onFrame) => runs.run(stage, onProgress, onFrame),
    found: (stage) =>
      guarded(stage, () => ({ ok: true, value: fieldsOf(session, [...stagesBefore, stage], noValue) })),
    fibres: () => guarded('fibres', () => ({ ok: true, value: fibresOf(session) })),
    stimulate: (json) => guarded('monodomain', () => JSON.parse(session.stimulate(json))),
    pauseSimulation: (paused) => runs.pause(paused),
    endSimulation: () => runs.end(),

    values: (file, onFrame) => eachFrame(session, file, onFrame),

    forecast: (elements) => guarded('forecast', () => JSON.parse(session.forecast(elements))),

    arrays: (stage) =>
      guarded(stage, () => {
        const arrays: Record<string, Held> = {};
        const keep = (from: string, names: readonly string[]) => {
          for (const name of names) {
            const view = session.array(from, name);
            if (view) arrays[name] = copied(view);
          }
        };
        if (stage === 'quality') return { ok: true, value: fieldsOf(session, stagesOfEvidence, -1) as never };
        const voxels = stage === 'volume' && session.array(stage, 'labels');
        if (voxels) arrays.labels = copiedLabels(voxels as Uint16Array);
        keep(stage, arrayNames[stage] ?? []);
        const thickness = stage === 'sizing' && session.array('walls', 'thickness_mm');
        if (thickness) arrays.thickness_mm = withNone(thickness as Float32Array, 0);
        if (stage === 'smooth' && arrays.triangles)
          arrays.normals = smoothNormals(arrays as unknown as SurfaceArrays);
        if (stage === 'optimise' && arrays.tets) {
          arrays.neighbours = tetNeighbours(arrays.tets as Uint32Array, arrays.points.length / 3);
          Object.assign(arrays, tetFaces(arrays as unknown as TetArrays));
          for (const name of ['tets', 'neighbours', 'faces', 'centres'])
            arrays[name] = withRoom(arrays[name] as Uint32Array<ArrayBuffer>);
        }
        return { ok: true, value: arrays as never };
      }),

    exportMesh: (format, space, name, measures, order) =>
      guarded('export', () => {
        const reply = JSON.parse(session.exportMesh(format, space, name, measures, order)) as Reply<{
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
  const { values = {} } = reply.value as { values?: object };
  for (const entry of [...Object.values(reply.value), ...Object.values(values)] as unknown[]) {
    const array = ArrayBuffer.isView(entry) ? entry : (entry as { bytes?: unknown } | null)?.bytes;
    if (ArrayBuffer.isView(array)) buffers.add(array.buffer as ArrayBuffer);
  }
  return [...buffers];
}
