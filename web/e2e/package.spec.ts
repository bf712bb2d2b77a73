/** The npm package, from its tarball in fresh folders: what its README shows is run as it stands. */
import { execFileSync, execSync } from 'node:child_process';
import {
  copyFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';
import { build, createServer } from 'vite';
import { serve } from '../serve.mjs';

const web = join(dirname(fileURLToPath(import.meta.url)), '..');
const packed = join(web, '../build/package');
const readme = readFileSync(join(web, 'package/README.md'), 'utf8');

/** A code block of the README, by the name of its file. */
function example(name: string): string {
  const block = new RegExp(`^\`\`\`\\w+ file=${name}\\n([\\s\\S]*?)^\`\`\``, 'm').exec(readme);
  if (!block) throw new Error(`The README of the package has no block file=${name}.`);
  return block[1];
}

const commands = /^```sh\n([\s\S]*?)^```/m.exec(readme)?.[1].trim().split('\n') ?? [];

/** A folder with the package, as npm installs it without a network. */
function freshFolder(): string {
  const tarball = existsSync(packed) && readdirSync(packed).find((name) => name.endsWith('.tgz'));
  if (!tarball) throw new Error('There is no package: run scripts/build package.');
  const folder = mkdtempSync(join(tmpdir(), 'voxtet-package-'));
  writeFileSync(join(folder, 'package.json'), '{ "private": true, "type": "module" }');
  const offline = ['--offline', '--no-audit', '--no-fund', '--silent'];
  execFileSync('npm', ['install', ...offline, join(packed, tarball)], { cwd: folder });
  return folder;
}

const node = (cwd: string, ...args: string[]) =>
  execFileSync(process.execPath, args, { cwd, encoding: 'utf8' });

let folder: string;
/** Of the command line's mesh. */
let digest: string;

test.beforeAll(() => {
  folder = freshFolder();
  expect(commands[0]).toBe('npm install voxtet');
  for (const command of commands.slice(1)) execSync(command, { cwd: folder, stdio: 'pipe' });
  ({ digest } = JSON.parse(readFileSync(join(folder, 'report.json'), 'utf8')));
});
test.afterAll(() => rmSync(folder, { recursive: true }));

test('node makes the mesh of the command line, and ends', () => {
  expect(execSync('npx voxtet --help', { cwd: folder, encoding: 'utf8' })).toContain(
    'mesh a volume or a case',
  );
  writeFileSync(join(folder, 'mesh.mjs'), example('mesh.mjs'));
  expect(node(folder, 'mesh.mjs')).toContain(`digest ${digest}`);
  for (const suffix of ['pts', 'elem']) expect(existsSync(join(folder, `heart.${suffix}`))).toBe(true);
});

test('the package brings its licence and its source', () => {
  const source = execSync('tar -tzf node_modules/voxtet/source.tar.gz', { cwd: folder, encoding: 'utf8' });
  for (const path of ['core/CMakeLists.txt', 'wasm/session_binding.cpp', 'web/src/mesher/node.ts'])
    expect(source.split('\n')).toContain(`voxtet/${path}`);
  expect(readFileSync(join(folder, 'node_modules/voxtet/LICENSE'), 'utf8')).toContain('GNU AFFERO');
});

test('types hold for what the README does', () => {
  writeFileSync(join(folder, 'mesh.mjs'), example('mesh.mjs'));
  const types = join(web, 'node_modules/@types');
  const options = {
    allowJs: true,
    checkJs: true,
    strict: true,
    noEmit: true,
    module: 'nodenext',
    target: 'es2022',
  };
  const config = {
    compilerOptions: { ...options, types: ['node'], typeRoots: [types] },
    files: ['mesh.mjs', 'wrong.mts'],
  };
  writeFileSync(join(folder, 'tsconfig.json'), JSON.stringify(config));
  writeFileSync(
    join(folder, 'wrong.mts'),
    [
      "import { createMesher, type EngineError } from 'voxtet';",
      'const mesher = await createMesher();',
      '// @ts-expect-error: there is no such field',
      'await mesher.run({ sizing: { edge: 2 } });',
      "export const told = (error: EngineError): 'usage' | '' => (error.code === 'usage' ? error.code : '');",
      "export const points: Float32Array = (await mesher.run({ source: { phantom: { kind: 'sphere' } } })).mesh.points;",
    ].join('\n'),
  );
  node(folder, join(web, 'node_modules/typescript/bin/tsc'), '-p', '.');
});

test('a job ends when its signal says so, and errors say what is wrong', () => {
  writeFileSync(
    join(folder, 'cancel.mjs'),
    `import { createMesher, EngineError } from 'voxtet';
    const mesher = await createMesher({ threads: false });
    const abort = new AbortController();
    const fine = { source: { phantom: { kind: 'biventricle' } }, sizing: { edge_mm: 1.2 } };
    const onProgress = (stage) => stage === 'remesh' && abort.abort();
    const told = (error) => console.log([error instanceof EngineError, error.code, error.stage].join(' '));
    await mesher.run(fine, { signal: abort.signal, onProgress }).catch(told);
    await mesher.run(fine, { signal: abort.signal }).catch(told);
    await mesher.export('vtu').catch(told);
    await mesher.run({}, { volume: { name: 'a.nii', bytes: new Uint8Array(9) } }).catch(told);
    await mesher.run({ sizing: { edge: 2 } }).catch(told);
    const ball = { source: { phantom: { kind: 'sphere', radius_mm: 20 } }, sizing: { edge_mm: 5 } };
    console.log("meshed " + ((await mesher.run(ball)).report.tets > 0));
    mesher.close();
    await mesher.run(ball).catch(told);`,
  );
  expect(node(folder, 'cancel.mjs').trim().split('\n')).toEqual([
    'true cancelled engine',
    'true cancelled engine',
    'true usage engine',
    'true bad_input read_volume',
    'true usage recipe',
    'meshed true',
    'true usage engine',
  ]);
});

test('runs that are asked for at once each have their own volume, and a forecast its own source', () => {
  writeFileSync(
    join(folder, 'queue.mjs'),
    `import { createMesher } from 'voxtet';
    const box = (name, n) => {
      const sizes = [n + 4, n + 4, n + 4];
      const lines = ['NRRD0004', 'type: uint8', 'dimension: 3', 'sizes: ' + sizes.join(' '), 'encoding: raw',
        'space: right-anterior-superior', 'space directions: (1,0,0) (0,1,0) (0,0,1)', 'space origin: (0,0,0)', '', ''];
      const voxels = Uint8Array.from({ length: sizes[0] ** 3 }, (_, at) =>
        [at, at / sizes[0], at / sizes[0] ** 2].every((x) => Math.floor(x) % sizes[0] > 1 && Math.floor(x) % sizes[0] < n + 2));
      return { name, bytes: Uint8Array.from([...new TextEncoder().encode(lines.join('\\n')), ...voxels]) };
    };
    const mesher = await createMesher({ threads: false });
    const recipe = { sizing: { edge_mm: 3 } };
    const runs = [box('a.nrrd', 8), box('b.nrrd', 12)].map((volume) => mesher.run(recipe, { volume }));
    for (const { report, recipe: full } of await Promise.all(runs))
      console.log(full.source.file.name + ' ' + report.fidelity.labels[0].voxels);
    const sphere = await mesher.forecast({ source: { phantom: { kind: 'sphere', radius_mm: 20 } }, sizing: { edge_mm: 5 } });
    console.log('forecast ' + (sphere.tets > 100));
    mesher.close();`,
  );
  expect(node(folder, 'queue.mjs').trim().split('\n')).toEqual([
    'a.nrrd 512',
    'b.nrrd 1728',
    'forecast true',
  ]);
});

test('a wave, the links of the app and the schema of recipes are there', () => {
  writeFileSync(
    join(folder, 'wave.mjs'),
    `import schema from 'voxtet/schema.json' with { type: 'json' };
    import { createMesher, decodeFragment, encodeFragment } from 'voxtet';
    const kinds = [{ labels: [1, 2], along_mm_per_ms: 0.6, across_mm_per_ms: 0.3 }];
    const stimuli = [{ name: 'apex', centre_mm: [0, 0, -40], radius_mm: 14 }];
    const monodomain = { end_ms: 4, step_ms: 0.2 };
    const recipe = await decodeFragment(
      await encodeFragment({
        source: { phantom: { kind: 'biventricle', spacing_mm: [4, 4, 4] } },
        labels: [1, 2],
        sizing: { edge_mm: 7 },
        physics: { anatomy: {}, fibres: {}, tissue: { kinds }, stimuli, monodomain },
      }),
    );
    const mesher = await createMesher();
    const { mesh } = await mesher.run(recipe);
    let frames = 0;
    const onFrame = ({ values }) => (frames += Object.values(values)[0].length * 3 === mesh.points.length);
    const { values, simulation } = await mesher.simulate('monodomain', { onFrame });
    console.log([frames > 1, Object.keys(values).includes('activation_ms'), simulation.monodomain.end_ms].join(' '));
    console.log(Object.keys(schema.properties).includes('sizing') ? 'schema' : 'no schema');
    mesher.close();`,
  );
  expect(node(folder, 'wave.mjs').trim().split('\n')).toEqual(['true true 4', 'schema']);
});

/** The page of the README in a folder of its own. */
function pageFolder(): string {
  const site = join(folder, 'site');
  mkdirSync(join(site, 'public'), { recursive: true });
  copyFileSync(join(folder, 'heart.nii.gz'), join(site, 'public/heart.nii.gz'));
  for (const name of ['index.html', 'main.js']) writeFileSync(join(site, name), example(name));
  return site;
}

const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

/** A page that Vite serves, and what ends it. */
type Served = { address: string; end(): unknown };

async function built(): Promise<Served> {
  const root = pageFolder();
  await build({ root, configFile: false, logLevel: 'warn' });
  const server = await serve({ root: join(root, 'dist'), port: 0 });
  const address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  return { address, end: () => server.close() };
}

async function developed(): Promise<Served> {
  const server = await createServer({
    root: pageFolder(),
    configFile: false,
    logLevel: 'warn',
    server: { host: '127.0.0.1', port: 0, headers: isolation },
  });
  await server.listen();
  const address = `http://127.0.0.1:${(server.httpServer!.address() as AddressInfo).port}/`;
  return { address, end: () => server.close() };
}

for (const [title, start, isolated] of [
  ['a page that Vite has built makes it too', built, true],
  ['so does one that may not share memory, without threads', built, false],
  ["so does one on Vite's development server", developed, true],
] as const)
  test(title, async ({ page }) => {
    const { address, end } = await start();
    if (!isolated)
      await page.route(address, async (route) => {
        const response = await route.fetch();
        const headers = response.headers();
        delete headers['cross-origin-embedder-policy'];
        await route.fulfill({ response, headers });
      });
    const threads: string[] = [];
    page.on('request', (request) => {
      if (request.url().includes('engine.worker')) threads.push(request.url());
    });
    await page.goto(address);
    await page.getByRole('button', { name: 'Mesh' }).click();
    await expect(page.locator('#told')).toContainText(`digest ${digest}`);
    expect(threads.length > 0).toBe(isolated);
    await end();
  });
