#!/usr/bin/env node
/** Builds the npm package from the engine in build/wasm and build/threads: build/package/voxtet-VERSION.tgz. */
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { rolldown } from 'rolldown';

const here = dirname(fileURLToPath(import.meta.url));
const web = dirname(here);
const root = dirname(web);
const out = join(root, 'build/package');
const made = join(out, 'voxtet');

const readJson = (path) => JSON.parse(readFileSync(path, 'utf8'));
const writeJson = (path, value) => writeFileSync(path, `${JSON.stringify(value, null, 2)}\n`);

async function bundle() {
  const build = await rolldown({
    cwd: web,
    input: {
      page: 'src/mesher/page.ts',
      node: 'src/mesher/node.ts',
      worker: 'src/engine/worker.ts',
      node_worker: 'src/engine/node_worker.ts',
    },
    external: /^node:/,
    resolve: { extensions: ['.ts', '.mjs', '.js'] },
  });
  await build.write({ dir: join(made, 'dist'), chunkFileNames: '[name].js' });
  await build.close();
}

/** The types that users see: those that the entry needs, with endings, which node's resolution asks for. */
function declare() {
  const all = join(out, 'declared');
  const tsc = join(web, 'node_modules/typescript/bin/tsc');
  const options = ['--noEmit', 'false', '--declaration', '--emitDeclarationOnly', '--stripInternal'];
  const places = ['-p', join(here, 'tsconfig.json'), '--outDir', all, '--rootDir', join(web, 'src')];
  execFileSync(process.execPath, [tsc, ...places, ...options], { stdio: 'inherit' });
  const wanted = new Set(['mesher/page.d.ts']);
  for (const path of wanted) {
    const text = readFileSync(join(all, path), 'utf8').replace(
      /(from\s+|import\()(['"])(\.[^'"]+)\2/g,
      (_, before, quote, target) => {
        wanted.add(`${join(dirname(path), target)}.d.ts`);
        return `${before}${quote}${target}.js${quote}`;
      },
    );
    mkdirSync(join(made, 'types', dirname(path)), { recursive: true });
    writeFileSync(join(made, 'types', path), text);
  }
  rmSync(all, { recursive: true });
}

function copyEngine() {
  const copy = (from, to, ...names) => {
    mkdirSync(join(made, to), { recursive: true });
    for (const name of names) cpSync(join(root, 'build', from, name), join(made, to, name));
  };
  copy('wasm', 'engine', 'voxtet_engine.mjs', 'voxtet_engine.wasm');
  const threads = ['voxtet_engine.mjs', 'voxtet_engine.wasm', 'voxtet_engine.worker.js'];
  copy('threads', 'engine/threads', ...threads);
  copy('wasm', 'cli', 'voxtet.mjs', 'voxtet_cli.js', 'voxtet_cli.wasm');
  // Emscripten's scripts that end in .js are CommonJS.
  for (const folder of ['engine/threads', 'cli'])
    writeJson(join(made, folder, 'package.json'), { type: 'commonjs' });
}

/** What the licence asks for: the source of all that is in the package. */
function packSource() {
  const engine = ['core', 'wasm', 'cmake', 'scripts', 'CMakeLists.txt', 'CMakePresets.json', 'LICENSE'];
  const client = [
    'src',
    'package',
    'package.json',
    'package-lock.json',
    'tsconfig.json',
    'public/recipe.schema.json',
  ];
  const options = ['--sort=name', '--owner=0', '--group=0', '--numeric-owner', '--transform=s,^,voxtet/,'];
  const paths = [...engine, ...client.map((path) => `web/${path}`)];
  execFileSync('tar', ['-czf', join(made, 'source.tar.gz'), ...options, ...paths], { cwd: root });
}

/** Whatever tells of the machine that the package was made on. */
function checkContents() {
  for (const path of readdirSync(made, { recursive: true, encoding: 'utf8' })) {
    if (path.endsWith('.map')) throw new Error(`${path}: a source map`);
    if (!/\.\w+$/.test(path)) continue;
    const text = readFileSync(join(made, path), 'latin1');
    for (const place of [root, process.env.HOME ?? root])
      if (place.length > 1 && text.includes(`${place}/`)) throw new Error(`${path}: names ${place}`);
  }
}

rmSync(out, { recursive: true, force: true });
mkdirSync(made, { recursive: true });
await bundle();
declare();
copyEngine();
packSource();
writeJson(join(made, 'package.json'), {
  ...readJson(join(here, 'package.json')),
  version: readJson(join(web, 'package.json')).version,
});
cpSync(join(web, 'public/recipe.schema.json'), join(made, 'schema.json'));
cpSync(join(here, 'README.md'), join(made, 'README.md'));
cpSync(join(root, 'LICENSE'), join(made, 'LICENSE'));
checkContents();
const packed = JSON.parse(
  execFileSync('npm', ['pack', '--json', '--pack-destination', out], { cwd: made, encoding: 'utf8' }),
);
const [{ filename, size, unpackedSize }] = Array.isArray(packed) ? packed : Object.values(packed);
const megabytes = (bytes) => `${(bytes / 1e6).toFixed(1)} MB`;
console.log(`${resolve(out, filename)}: ${megabytes(size)} packed, ${megabytes(unpackedSize)} unpacked`);
