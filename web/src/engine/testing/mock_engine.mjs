/** A small engine of the same surface as the wasm module: a ball in a ball, cut into five tetrahedra a cube. */
import { optionalDefaults, recipeDefaults, stageSpecs } from '../generated';
import { oppositeFace, tetNeighbours } from '../../geometry/tet_neighbours';

/** A simulation gives so many frames, one in each part. */
const frameCount = 20;
const nothingRecorded = { trace_times_ms: [], traces: [] };
const playedFields = {
  mechanics: { name: 'displacement_mm', title: 'Displacement', unit: 'mm', components: 3 },
  diffusion: { name: 'temperature', title: 'Temperature', unit: '1' },
  monodomain: { name: 'voltage_mV', title: 'Membrane voltage', unit: 'mV' },
};
const cubeTets = [
  [0, 1, 3, 5],
  [0, 3, 2, 6],
  [0, 5, 4, 6],
  [3, 5, 6, 7],
  [0, 3, 5, 6],
];
const stages = stageSpecs.map(({ name }) => name);
const { expected, ...defaults } = recipeDefaults;
const phantomDefaults = optionalDefaults['source.phantom'];

function hash(text) {
  let a = 0x811c9dc5;
  for (const c of text) a = Math.imul(a ^ c.charCodeAt(0), 0x01000193) >>> 0;
  return a.toString(16).padStart(8, '0').repeat(8);
}

function merged(base, change, path) {
  const out = { ...base };
  for (const [key, value] of Object.entries(change)) {
    if (!(key in base) && !path.startsWith('source') && !['expected', 'physics'].includes(key))
      throw new Error(`${path}${key}: unknown field`);
    const inner = base[key];
    out[key] =
      inner && typeof inner === 'object' && !Array.isArray(inner)
        ? merged(inner, value, `${path}${key}.`)
        : value;
  }
  return out;
}

function ballMesh(cells) {
  const n = cells + 1;
  const points = [];
  for (let k = 0; k < n; k++)
    for (let j = 0; j < n; j++)
      for (let i = 0; i < n; i++) points.push(4 * i - 2 * cells, 4 * j - 2 * cells, 4 * k - 2 * cells);
  const tets = [];
  const labels = [];
  for (let k = 0; k < cells; k++)
    for (let j = 0; j < cells; j++)
      for (let i = 0; i < cells; i++) {
        const odd = (i + j + k) % 2;
        const corner = (c) => {
          const x = odd ? 1 - (c & 1) : c & 1;
          return i + x + n * (j + ((c >> 1) & 1) + n * (k + (c >> 2)));
        };
        const r = Math.hypot(i + 0.5 - cells / 2, j + 0.5 - cells / 2, k + 0.5 - cells / 2);
        if (r > cells / 2) continue;
        for (const [a, b, c, d] of cubeTets) {
          const tet = [corner(a), corner(b), corner(c), corner(d)];
          if (!odd) tet.reverse();
          const [p, q, s, t] = tet.map((v) => points.slice(3 * v, 3 * v + 3));
          const u = q.map((x, m) => x - p[m]);
          const v = s.map((x, m) => x - p[m]);
          const w = t.map((x, m) => x - p[m]);
          const det =
            u[0] * (v[1] * w[2] - v[2] * w[1]) +
            u[1] * (v[2] * w[0] - v[0] * w[2]) +
            u[2] * (v[0] * w[1] - v[1] * w[0]);
          if (det < 0) [tet[0], tet[1]] = [tet[1], tet[0]];
          tets.push(...tet);
          labels.push(r > cells / 3.2 ? 1 : 2);
        }
      }
  return {
    points: Float32Array.from(points),
    tets: Uint32Array.from(tets),
    labels: Uint16Array.from(labels),
  };
}

function boundary(mesh) {
  const neighbours = tetNeighbours(mesh.tets, mesh.points.length / 3);
  const triangles = [];
  const sides = [];
  neighbours.forEach((other, face) => {
    const own = mesh.labels[face >> 2];
    const beyond = other < 0 ? 0 : mesh.labels[other];
    if (own <= beyond) return;
    for (const c of oppositeFace[face & 3]) triangles.push(mesh.tets[(face & ~3) + c]);
    sides.push(own, beyond);
  });
  return { triangles: Uint32Array.from(triangles), sides: Uint16Array.from(sides) };
}

function metric(name, unit, elements, lo, hi, worst = []) {
  const counts = Array.from({ length: 64 }, (_, i) => Math.round(1000 * Math.exp(-(((i - 30) / 11) ** 2))));
  const mid = (lo + hi) / 2;
  return {
    name,
    title: '',
    unit,
    elements,
    count: 64,
    min: lo,
    p01: lo,
    p1: lo,
    p5: lo,
    median: mid,
    p95: hi,
    p99: hi,
    max: hi,
    mean: mid,
    sd: 1,
    histogram: { lo, hi, counts },
    worst,
  };
}

class Session {
  recipe = structuredClone(defaults);
  file = null;
  done = new Set();
  sides = new Map();
  mesh = null;
  exported = [];

  schema() {
    return JSON.stringify({
      version: 'mock',
      fields: [{ path: 'sizing.edge_mm', type: 'number', unit: 'mm', min: 0.01, max: 100 }],
    });
  }
  defaults() {
    return JSON.stringify(defaults);
  }
  summary() {
    const name = this.file?.name ?? 'phantom';
    return {
      name,
      size: [12, 12, 12],
      spacing_mm: [4, 4, 4],
      index_to_mm: [4, 0, 0, -22, 0, 4, 0, -22, 0, 0, 4, -22, 0, 0, 0, 1],
      digest: this.file?.digest ?? hash('phantom'),
      labels: [
        { label: 1, name: 'Wall', colour: null, voxels: 700 },
        { label: 2, name: 'Core', colour: null, voxels: 200 },
      ],
      warnings: [],
      ...(this.hasMesh() && { mesh: { points: 4, tets: 1, fibres: false } }),
    };
  }
  /** An opened file of tetrahedra is the mesh: no stage makes one. */
  hasMesh() {
    return !this.recipe.source.phantom && /\.elem$/.test(this.file?.name ?? '');
  }
  loadVolume(name, bytes) {
    if (name.includes('memory')) throw new RangeError('Array buffer allocation failed: Out of memory');
    if (name.includes('abort')) throw new Error('RuntimeError: Aborted()');
    if (bytes.length < 8) {
      return JSON.stringify({
        ok: false,
        error: {
          code: 'bad_input',
          stage: 'volume',
          message: `${name}: ends after ${bytes.length} bytes`,
          where: {},
        },
      });
    }
    this.file = { name, digest: hash(String(bytes)) };
    this.recipe.source = { file: { name, sha256: this.file.digest } };
    this.done.clear();
    return JSON.stringify({ ok: true, value: this.summary() });
  }
  loadSideVolume(kind, name, bytes) {
    this.sides.set(name, bytes);
    const labels = kind === 'mask' ? [1] : [];
    return JSON.stringify({ ok: true, value: { name, digest: hash(String(bytes)), labels } });
  }
  inlineCase() {
    const { file, ...source } = this.recipe.source;
    const recipe = { ...this.recipe, source: { ...source, inline: { name: file.name, data: 'AQ' } } };
    return JSON.stringify({ ok: true, value: { recipe, minimal: { source: recipe.source } } });
  }
  setRecipe(text) {
    try {
      const minimal = JSON.parse(text);
      const before = JSON.stringify({ ...this.recipe, physics: undefined });
      this.recipe = merged(defaults, minimal, '');
      const { phantom } = this.recipe.source;
      if (phantom) this.recipe.source = { phantom: { ...phantomDefaults, ...phantom } };
      if (JSON.stringify({ ...this.recipe, physics: undefined }) !== before) this.done.clear();
      return JSON.stringify({ ok: true, value: { recipe: this.recipe, minimal } });
    } catch (error) {
      return JSON.stringify({
        ok: false,
        error: { code: 'usage', stage: 'recipe', message: error.message, where: {} },
      });
    }
  }
  begin(stage) {
    this.last = stage;
    this.frame = 0;
    this.waiting = [];
    return JSON.stringify({ ok: true, value: null });
  }
  end() {
    this.last = null;
  }
  advance(_budgetMs, onProgress) {
    if (!(this.last in playedFields)) return this.advanceTo(this.last, onProgress);
    if (!this.done.has('quality')) this.advanceTo('quality', onProgress);
    const [stage, fraction] = [this.last, ++this.frame / frameCount];
    const info = { ...playedFields[stage], on: 'points', scale: 'sequential' };
    const count = this.mesh.points.length / 3;
    const field = { components: 1, ...info, count, range: [0, fraction] };
    const time_ms = 5 * this.frame;
    const recorded = stage === 'mechanics' && {
      trace_times_ms: [time_ms - 2.5, time_ms],
      traces: [{ name: 'lv_volume', title: 'Volume', unit: 'ml', values: [time_ms, 2 * time_ms] }],
    };
    this.waiting.push({ time_ms, fields: [field], ...nothingRecorded, ...recorded });
    onProgress(stage, fraction);
    const done = fraction === 1;
    const summary = done
      ? { name: stage, key: hash(stage), cached: false, notes: [], counts: {} }
      : undefined;
    return JSON.stringify({ ok: true, value: { done, stage, fraction, summary } });
  }
  stimulate(text) {
    const now = 5 * this.frame;
    const given = JSON.parse(text);
    const stimulus = { ...given, start_ms: given.start_ms + now };
    this.recipe.physics = {
      ...this.recipe.physics,
      stimuli: [...(this.recipe.physics?.stimuli ?? []), stimulus],
    };
    return JSON.stringify({ ok: true, value: { stimulus } });
  }
  takeSnapshot() {
    this.taken = this.waiting.shift() ?? null;
    return JSON.stringify({ ok: true, value: this.taken });
  }
  /** Values as they come: a byte is a point's value, as many frames as there are points in them. */
  openValues(name, bytes) {
    const points = this.mesh.points.length / 3;
    if (bytes.length % points !== 0) {
      const message = `${name}: found ${bytes.length} values, expected ${points}, one for each point of the mesh`;
      return JSON.stringify({ ok: false, error: { code: 'bad_input', stage: 'values', message, where: {} } });
    }
    this.values = { name, bytes };
    return JSON.stringify({ ok: true, value: { frames: bytes.length / points } });
  }
  valuesFrame(frame) {
    const count = this.mesh.points.length / 3;
    const name = this.values.name.replace(/\.[^.]*$/, '').replace(/.*\./, '');
    const info = {
      name,
      title: this.values.name,
      unit: '1',
      on: 'points',
      scale: 'sequential',
      components: 1,
    };
    const part = Float32Array.from(this.values.bytes.subarray(frame * count, (frame + 1) * count));
    this.part = part;
    const range = [Math.min(...part), Math.max(...part)];
    const fields = [{ ...info, count, range }];
    return JSON.stringify({ ok: true, value: { time_ms: 5 * frame, fields, ...nothingRecorded } });
  }
  closeValues() {
    this.values = null;
  }
  snapshotArray() {
    if (this.values) return this.part;
    const { time_ms, fields } = this.taken;
    return new Float32Array(fields[0].components * fields[0].count).fill(time_ms / 100);
  }
  advanceTo(stage, onProgress) {
    if (!this.recipe.source.phantom && !this.file) {
      return JSON.stringify({
        ok: false,
        error: { code: 'usage', stage: 'volume', message: 'no volume has been loaded', where: {} },
      });
    }
    const missing = this.recipe.sizing.masks.find(({ name }) => !this.sides.has(name));
    if (missing && stage !== 'volume') {
      const message = `sizing.masks[0]: the file '${missing.name}' has not been loaded`;
      return JSON.stringify({ ok: false, error: { code: 'bad_input', stage: 'sizing', message, where: {} } });
    }
    this.mesh ??= ballMesh(10);
    const summaries = [];
    for (const name of stages.slice(0, stages.indexOf(stage) + 1)) {
      if (this.hasMesh() && ['surface', 'smooth', 'sizing', 'remesh', 'tetra'].includes(name)) continue;
      const cached = this.done.has(name);
      if (!cached) for (const fraction of [0, 0.5, 1]) onProgress(name, fraction);
      this.done.add(name);
      summaries.push({
        name,
        seconds: 0.01,
        cached,
        peak_mb: 1,
        key: hash(name + JSON.stringify(this.recipe)),
        notes: [],
        counts: this.counts(name),
      });
    }
    const value = { done: true, stage, fraction: 1, summary: summaries.at(-1) };
    return JSON.stringify({ ok: true, value });
  }
  describe(stage) {
    const names = {
      quality: ['min_dihedral_deg', 'max_dihedral_deg', 'radius_ratio', 'edge_mm', 'target_mm', 'size_log2'],
      transfer: this.recipe.transfer.labels.length
        ? [
            'centroid_label',
            'majority_label',
            ...this.recipe.transfer.labels.map((label) => `fraction_${label}`),
          ]
        : [],
    };
    const value = (names[stage] ?? []).map((name) => ({
      name,
      title: name,
      unit: name.endsWith('deg') ? 'deg' : '1',
      on: 'tets',
      scale: name.endsWith('_label') ? 'label' : name === 'size_log2' ? 'diverging' : 'sequential',
      components: 1,
      count: this.mesh.labels.length,
      range: [0, 1],
    }));
    return JSON.stringify({ ok: true, value });
  }
  forecast(elements) {
    const { sizing } = this.recipe;
    const of = (edge) => ({
      tets: Math.round(1e6 / edge ** 3),
      points: 100,
      triangles: 100,
      peak_mb: 70,
      seconds: 2,
      seconds_here: [1, 3],
    });
    if (!elements) return JSON.stringify({ ok: true, value: of(sizing.edge_mm) });
    const edge_mm = Math.cbrt(1e6 / elements);
    const fitting = {
      factor: edge_mm / sizing.edge_mm,
      edge_mm,
      sizing: { ...sizing, edge_mm },
      forecast: of(edge_mm),
    };
    return JSON.stringify({ ok: true, value: { ...of(sizing.edge_mm), fitting } });
  }
  counts(name) {
    if (name === 'volume') return this.summary();
    if (name === 'sizing')
      return { size: [12, 12, 12], index_to_mm: this.summary().index_to_mm, min_mm: 1, max_mm: 4 };
    if (name === 'tetra' || name === 'optimise')
      return { points: this.mesh.points.length / 3, tets: this.mesh.labels.length, faces: 0 };
    return { points: this.mesh.points.length / 3, triangles: boundary(this.mesh).sides.length / 2 };
  }
  array(stage, array) {
    if (!this.done.has(stage) || stage === 'walls') return undefined;
    if (stage === 'volume') return new Uint16Array(12 ** 3).map((_, i) => (i % 12 > 3 && i % 12 < 8 ? 1 : 0));
    if (stage === 'transfer') return new Float32Array(this.mesh.labels.length).fill(0.5);
    if (stage === 'sizing') return new Float32Array(12 ** 3).map((_, i) => 1 + 3 * ((i % 12) / 12));
    if (stage === 'quality') {
      return new Float32Array(this.mesh.labels.length).map((_, i) =>
        array.includes('dihedral') ? 20 + (i % 80) : 0.5 + (i % 10) / 5,
      );
    }
    if (stage === 'optimise') return this.mesh[array];
    // Fibres along x, and a wall whose depth is z and whose base is at high y.
    if (stage === 'fibres')
      return this.recipe.physics?.fibres
        ? new Float32Array(3 * this.mesh.labels.length).map((_, i) => (i % 3 === 0 ? 1 : 0))
        : undefined;
    if (stage === 'anatomy') {
      const axis = array === 'transmural' ? 2 : 1;
      return this.mesh.points.filter((_, i) => i % 3 === axis);
    }
    return array === 'points' ? this.mesh.points : boundary(this.mesh)[array];
  }
  exportMesh(format, space, name) {
    const several = { carp: ['.pts', '.elem', '.lon.txt'], xdmf: ['.xdmf', '.h5'] };
    const files = several[format] ?? [`.${format}`];
    this.exported = files.map((suffix) => ({
      suffix,
      bytes: new TextEncoder().encode(`${format} ${space} ${name}`),
    }));
    return JSON.stringify({
      ok: true,
      value: { files: this.exported.map(({ suffix, bytes }) => ({ suffix, bytes: bytes.length })) },
    });
  }
  exportBytes(index) {
    return this.exported[index].bytes;
  }
  report() {
    const distance = {
      samples: 10,
      spacing_mm: 0.5,
      mean_mm: 0.1,
      rms_mm: 0.1,
      p95_mm: 0.2,
      max_mm: 0.3,
      uncertainty_mm: 0.01,
    };
    return JSON.stringify({
      engine: 'mock',
      digest: hash(JSON.stringify(this.recipe)),
      tets: this.mesh.labels.length,
      points: this.mesh.points.length / 3,
      source: this.summary(),
      stages: [],
      quality: {
        passed: true,
        metrics: [
          metric('min_dihedral_deg', 'deg', 'tets', 12, 70, [5, 90, 300]),
          metric('dihedral_deg', 'deg', 'dihedrals', 12, 150),
          metric('radius_ratio', '1', 'tets', 0.2, 1, [7]),
          metric('edge_mm', 'mm', 'edges', 1, 5),
          metric('target_edge_mm', 'mm', 'edges', 1.2, 4),
          metric('triangle_aspect_before', '1', 'triangles', 1, 6),
          metric('triangle_aspect_after', '1', 'triangles', 1, 2.5),
        ],
        checklist: [
          { name: 'no_inverted_tets', passed: true, hard: true, found: '0', expected: '0' },
          { name: 'min_dihedral', passed: false, hard: false, found: '12.1 deg', expected: '14 deg' },
        ],
      },
      fidelity: {
        labels: [
          {
            label: 1,
            voxels: 700,
            tets: 2000,
            voxel_mm3: 44800,
            mesh_mm3: 44700,
            volume_error_percent: -0.2,
            dice: 0.99,
            median_edge_mm: 2.1,
            target_edge_mm: 2,
          },
        ],
        mesh_to_surface: distance,
        surface_to_mesh: distance,
        topology: {
          labels: [
            {
              label: 1,
              components: [1, 1],
              cavities: [0, 0],
              handles: [1, 0],
              euler: [0, 2],
              pinched_edges: 0,
              pinched_points: 0,
            },
          ],
          contacts: { before: [[0, 1]], after: [[0, 1]] },
          differences: ['label 1: handles 1 -> 0'],
        },
      },
      recipe: this.recipe,
      warnings: [],
    });
  }
  delete() {}
}

export default async function createVoxtet() {
  return { Session };
}
