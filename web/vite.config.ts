import { createHash } from 'node:crypto';
import { existsSync, readdirSync, readFileSync, renameSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { writeServiceWorker } from './offline.mjs';
import { engineInterface } from './src/engine/interface';

const contentPolicy = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "style-src 'self'",
  "img-src 'self' data: blob:",
  "font-src 'self'",
  // Files of cases may lie on other hosts; the page asks before it fetches one.
  "connect-src 'self' data: https:",
  "worker-src 'self'",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

/** The dev server injects inline styles and scripts, so only the built page carries the policy. */
function contentPolicyMeta(): Plugin {
  return {
    name: 'content-policy-meta',
    apply: 'build',
    transformIndexHtml: () => [
      {
        tag: 'meta',
        attrs: { 'http-equiv': 'Content-Security-Policy', content: contentPolicy },
        injectTo: 'head-prepend',
      },
    ],
  };
}

/** What @itk-wasm/dicom fetches while it reads: its own files, from our own origin. */
const dicomFiles = [
  '@itk-wasm/dicom/dist/pipelines/read-overlapping-segmentation.js',
  '@itk-wasm/dicom/dist/pipelines/read-overlapping-segmentation.wasm.zst',
  'itk-wasm/dist/pipeline/web-workers/bundles/itk-wasm-pipeline.min.worker.js',
];

/** In a folder that is named by their digest. */
function ownDicomFiles(): Plugin {
  const files = dicomFiles.map((path) => readFileSync(new URL(`node_modules/${path}`, import.meta.url)));
  const digest = createHash('sha256');
  for (const file of files) digest.update(file);
  const folder = `assets/dicom-${digest.digest('hex').slice(0, 8)}`;
  return {
    name: 'own-dicom-files',
    apply: 'build',
    config: () => ({ define: { 'import.meta.env.VITE_DICOM': JSON.stringify(folder) } }),
    generateBundle() {
      for (const [i, path] of dicomFiles.entries())
        this.emitFile({
          type: 'asset',
          fileName: `${folder}/${path.slice(path.lastIndexOf('/') + 1)}`,
          source: files[i],
        });
    },
  };
}

/**
 * The engine's files in a folder that is named by their digest, beside whatever else never changes under its name: a
 * browser asks for each of them once, however many threads want it.
 */
function namedEngine(): Plugin {
  const files = new URL('public/engine/', import.meta.url);
  const digest = createHash('sha256');
  // Unit tests run without the engine.
  const names = existsSync(files) ? readdirSync(files, { recursive: true, encoding: 'utf8' }) : [];
  for (const name of names.sort())
    if (/\.\w+$/.test(name)) digest.update(name).update(readFileSync(new URL(name, files)));
  const folder = `assets/engine-${digest.digest('hex').slice(0, 8)}`;
  const list = () => {
    const { version } = JSON.parse(readFileSync(new URL('version.json', files), 'utf8'));
    return `${JSON.stringify({ [version]: { folder: `${folder}/`, interface: engineInterface } }, null, 1)}\n`;
  };
  return {
    name: 'named-engine',
    apply: 'build',
    config: () => ({ define: { 'import.meta.env.VITE_ENGINE': JSON.stringify(`${folder}/`) } }),
    // Which versions are here; keep_engines.mjs adds those of earlier builds.
    generateBundle() {
      if (names.length > 0) this.emitFile({ type: 'asset', fileName: 'engines.json', source: list() });
    },
    closeBundle: () =>
      renameSync(new URL('dist/engine', import.meta.url), new URL(`dist/${folder}`, import.meta.url)),
  };
}

/** The last of all: it lists what the others have made. */
function serviceWorker(): Plugin {
  return {
    name: 'service-worker',
    apply: 'build',
    closeBundle: {
      order: 'post',
      sequential: true,
      handler: async () => void (await writeServiceWorker(fileURLToPath(new URL('dist', import.meta.url)))),
    },
  };
}

export default defineConfig({
  base: './',
  plugins: [contentPolicyMeta(), ownDicomFiles(), namedEngine(), serviceWorker()],
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
    modulePreload: { polyfill: false },
    // All that the page loads at first, but for the views, is one chunk: several small ones compress worse.
    rolldownOptions: {
      input: ['index.html', 'verification.html'],
      output: {
        codeSplitting: {
          groups: [
            {
              name: 'shared',
              test: /src\/(store|link|geometry|engine|report|panels)\/|node_modules\/(@?preact|immer|comlink)/,
              tags: ['$initial'],
            },
          ],
        },
      },
    },
  },
  server: {
    host: '127.0.0.1',
    headers: {
      'Cross-Origin-Opener-Policy': 'same-origin',
      'Cross-Origin-Embedder-Policy': 'require-corp',
    },
  },
});
