#!/usr/bin/env node
/** Checks the rules of src/: who may import whom, which package lives where, no long files, no `any`. */
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const src = join(dirname(fileURLToPath(import.meta.url)), 'src');
const maxLines = 400;

/** Folders, or single files of theirs, that each folder may import beside itself. */
const maySee = {
  engine: ['geometry'],
  geometry: ['engine/contract'],
  link: ['engine/contract'],
  report: ['engine/contract', 'geometry'],
  dicom: ['geometry'],
  store: ['engine', 'geometry', 'link', 'report', 'dicom'],
  scene: ['engine/contract', 'geometry', 'store'],
  panels: ['engine/contract', 'geometry', 'link', 'report', 'scene/scene', 'store'],
  styles: [],
};
/** Packages, and the only folders that may name them; '.' is main.tsx. */
const packages = {
  three: ['scene'],
  comlink: ['engine'],
  immer: ['store'],
  fflate: ['store'],
  '@itk-wasm/dicom': ['dicom'],
  uplot: ['panels'],
  preact: ['panels', '.'],
  '@preact/signals': ['store', 'scene', 'panels', '.'],
};
const testPackages = ['vitest', 'fast-check', 'node:'];

function withoutCommentsAndTexts(text) {
  return text.replace(
    /\/\*[\s\S]*?\*\/|\/\/[^\n]*|'(?:\\.|[^'\\\n])*'|"(?:\\.|[^"\\\n])*"|`(?:\\.|[^`\\])*`/g,
    '""',
  );
}

export function faultsOf(path, text) {
  const faults = [];
  const folder = path.includes('/') ? path.slice(0, path.indexOf('/')) : '.';
  const test = /\.test\.tsx?$|\/testing\//.test(path);
  const lines = text.split('\n').length - 1;
  if (lines > maxLines) faults.push(`${path}: ${lines} lines, more than ${maxLines}`);
  if (path.endsWith('.css')) return faults;
  if (/(?:[:<|&,(]|\bas|=>)\s*any\b/.test(withoutCommentsAndTexts(text)))
    faults.push(`${path}: the type any`);
  for (const [, target] of text.matchAll(/(?:from|import)\s*\(?\s*['"]([^'"]+)['"]/g)) {
    if (target.startsWith('.')) {
      const seen = relative(src, join(src, dirname(path), target));
      const allowed =
        folder === '.' || seen.startsWith(`${folder}/`) || (test && seen.startsWith('engine/testing/'));
      if (!allowed && !(maySee[folder] ?? []).some((one) => seen === one || seen.startsWith(`${one}/`)))
        faults.push(`${path}: ${folder}/ may not import ${seen}`);
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
  const files = readdirSync(src, { recursive: true, encoding: 'utf8' }).filter((path) =>
    /\.(tsx?|css)$/.test(path),
  );
  const faults = files.flatMap((path) => faultsOf(path, readFileSync(join(src, path), 'utf8')));
  console.log(faults.join('\n') || `rules of src/ hold in ${files.length} files`);
  return faults.length > 0 ? 1 : 0;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) process.exit(main());
