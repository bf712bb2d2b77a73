#!/usr/bin/env node
/** Checks the rules of src/: who may import whom, which package lives where, no long file, no crowded folder, no `any`. */
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const src = join(dirname(fileURLToPath(import.meta.url)), 'src');
const maxLines = 400;
const maxFiles = 20;
const isTest = (path) => /\.test\.tsx?$|\/testing\//.test(path);

/**
 * Rooms: folders of src/, and sub-folders that have rules of their own. Each may import from itself and from these
 * folders or single files; a folder's own files, beside its sub-rooms, are a room as well. Two circles are meant: the
 * types of `engine/contract` are seen by `geometry`, and `store/run` reads three files of `store/case`, which reads all
 * of the run.
 */
const engineAndShapes = ['engine/contract', 'geometry'];
const aroundPanels = [...engineAndShapes, 'link', 'report', 'store'];
const maySee = {
  engine: ['geometry'],
  geometry: ['engine/contract'],
  link: ['engine/contract'],
  mesher: ['engine', 'link'],
  report: [...engineAndShapes, 'link'],
  dicom: ['geometry'],
  store: [...engineAndShapes, 'store/case/input'],
  'store/run': [
    ...['engine', 'geometry', 'link', 'store/view', 'store/notices'],
    ...['store/case/recipe', 'store/case/input', 'store/case/side_files'],
  ],
  'store/study': ['engine/contract', 'link', 'store/notices'],
  'store/case': [
    ...['engine', 'geometry', 'link', 'report', 'dicom'],
    ...['store/run', 'store/study', 'store/view', 'store/notices'],
  ],
  'store/embed': [...['engine/contract', 'link', 'store/case', 'store/run', 'store/view', 'store/notices']],
  lessons: [...engineAndShapes, 'link', 'store'],
  scene: [...engineAndShapes, 'store', 'scene'],
  'scene/frame': [...engineAndShapes, 'store'],
  'scene/mesh': [...engineAndShapes, 'store', 'scene/frame'],
  'scene/slices': [...engineAndShapes, 'store', 'scene/frame'],
  panels: [...aroundPanels, 'panels'],
  'panels/controls': aroundPanels,
  'panels/run': [...aroundPanels, 'panels/controls'],
  'panels/physics': [...aroundPanels, 'panels/controls'],
  'panels/case': [...aroundPanels, 'panels/controls', 'panels/run', 'panels/physics'],
  'panels/view': [...aroundPanels, 'panels/controls', 'panels/case', 'scene/scene'],
  'panels/lessons': [...aroundPanels, 'lessons', 'panels/controls'],
  'panels/embed': [...aroundPanels, 'panels/controls', 'panels/view'],
  'panels/evidence': [...aroundPanels, 'panels/controls'],
  'panels/study': [...aroundPanels, 'panels/controls'],
  'panels/dialogs': [
    ...aroundPanels,
    ...['panels/controls', 'panels/run', 'panels/case', 'panels/view', 'panels/lessons'],
  ],
  verification: ['styles'],
  styles: [],
};
/** Packages, and the only folders that may name them; '.' is main.tsx. */
const packages = {
  three: ['scene'],
  comlink: ['engine'],
  'node:fs': ['engine'],
  'node:module': ['engine'],
  'node:os': ['engine'],
  'node:worker_threads': ['engine'],
  immer: ['store'],
  fflate: ['store'],
  'lean-qr': ['panels'],
  '@itk-wasm/dicom': ['dicom'],
  uplot: ['panels'],
  preact: ['panels', '.'],
  '@preact/signals': ['store', 'lessons', 'scene', 'panels', 'verification', '.'],
};
/** Made by generate_contract.mjs, not written. */
const generated = 'engine/generated.ts';
const testPackages = ['vitest', 'fast-check', 'node:'];

function withoutCommentsAndTexts(text) {
  return text.replace(
    /\/\*[\s\S]*?\*\/|\/\/[^\n]*|'(?:\\.|[^'\\\n])*'|"(?:\\.|[^"\\\n])*"|`(?:\\.|[^`\\])*`/g,
    '""',
  );
}

/** The room of a file, by its path in src/; '.' is src/ itself. */
function roomOf(path) {
  const folders = dirname(path).split('/');
  const inner = folders.slice(0, 2).join('/');
  return inner in maySee ? inner : folders[0];
}

/** Folders that hold too many source files directly, by the paths of all files of src/. Tests do not count. */
export function crowdedFolders(paths) {
  const counts = new Map();
  for (const path of paths.filter((one) => !isTest(one)))
    counts.set(dirname(path), (counts.get(dirname(path)) ?? 0) + 1);
  return [...counts]
    .filter(([, count]) => count > maxFiles)
    .map(([folder, count]) => `${folder}: ${count} files, more than ${maxFiles}; make rooms in it`);
}

export function faultsOf(path, text) {
  const faults = [];
  const folder = path.includes('/') ? path.slice(0, path.indexOf('/')) : '.';
  const room = roomOf(path);
  const test = isTest(path);
  const lines = text.split('\n').length - 1;
  if (lines > maxLines) faults.push(`${path}: ${lines} lines, more than ${maxLines}`);
  if (path.endsWith('.css')) return faults;
  if (/(?:[:<|&,(]|\bas|=>)\s*any\b/.test(withoutCommentsAndTexts(text)))
    faults.push(`${path}: the type any`);
  for (const [, target] of text.matchAll(/(?:from|import)\s*\(?\s*['"]([^'"]+)['"]/g)) {
    if (target.startsWith('.')) {
      const seen = relative(src, join(src, dirname(path), target));
      const allowed = folder === '.' || roomOf(seen) === room || (test && seen.startsWith('engine/testing/'));
      if (!allowed && !(maySee[room] ?? []).some((one) => seen === one || seen.startsWith(`${one}/`)))
        faults.push(`${path}: ${room}/ may not import ${seen}`);
    } else if (!(test && testPackages.some((name) => target.startsWith(name)))) {
      const owner = Object.keys(packages)
        .filter((name) => target === name || target.startsWith(`${name}/`))
        .sort((a, b) => b.length - a.length)[0];
      const homes = owner ? packages[owner] : [];
      if (!homes.includes(folder) && !test)
        faults.push(`${path}: ${target} may only be imported in ${homes.join(', ') || 'no folder'}`);
    }
  }
  return faults;
}

function main() {
  const files = readdirSync(src, { recursive: true, encoding: 'utf8' }).filter(
    (path) => /\.(tsx?|css)$/.test(path) && path !== generated,
  );
  const faults = files.flatMap((path) => faultsOf(path, readFileSync(join(src, path), 'utf8')));
  faults.push(...crowdedFolders(files));
  console.log(faults.join('\n') || `rules of src/ hold in ${files.length} files`);
  return faults.length > 0 ? 1 : 0;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) process.exit(main());
