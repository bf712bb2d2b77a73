#!/usr/bin/env node
/**
 * Keeps the engines of an earlier build beside the one of a new build, so that links open with the engine that made
 * them: node keep_engines.mjs OLD_DIST [NEW_DIST, by default dist]. Of OLD_DIST the engines are copied that its
 * engines.json names and NEW_DIST does not have; the app itself stays the new one.
 */
import { cpSync, existsSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const sourceName = 'voxtet-source.tar.gz';

function listOf(dist) {
  const path = join(dist, 'engines.json');
  if (!existsSync(path))
    throw new Error(`${path}: there is none; expected a built app that lists its engines`);
  return JSON.parse(readFileSync(path, 'utf8'));
}

/** The versions that were added. */
export function keepEngines(oldDist, newDist) {
  const before = listOf(oldDist);
  const now = listOf(newDist);
  const added = [];
  for (const [version, entry] of Object.entries(before)) {
    if (now[version]) continue;
    if (!/^assets\/engine-[0-9a-f]{8,}\/$/.test(entry.folder))
      throw new Error(
        `${oldDist}/engines.json: found the folder ${entry.folder}, expected assets/engine-DIGEST/`,
      );
    const [from, to] = [oldDist, newDist].map((dist) => join(dist, entry.folder));
    cpSync(from, to, { recursive: true });
    // The licence asks for the source of what is served: an engine that was kept before has its own already.
    const source = join(oldDist, sourceName);
    if (!existsSync(join(to, sourceName)) && existsSync(source)) cpSync(source, join(to, sourceName));
    now[version] = entry;
    added.push(version);
  }
  const path = join(newDist, 'engines.json');
  writeFileSync(`${path}.new`, `${JSON.stringify(now, null, 1)}\n`);
  renameSync(`${path}.new`, path);
  return added;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [oldDist, newDist = fileURLToPath(new URL('dist', import.meta.url))] = process.argv.slice(2);
  if (!oldDist) {
    console.error('usage: node keep_engines.mjs OLD_DIST [NEW_DIST]');
    process.exit(1);
  }
  try {
    console.log(keepEngines(oldDist, newDist).join('\n') || 'Nothing to keep: all engines are there.');
  } catch (error) {
    console.error(error.message);
    process.exit(1);
  }
}
