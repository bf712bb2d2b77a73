/**
 * Engines of earlier releases that stand beside the page's own, so that a link opens with the one that made it. Each is
 * a folder named by the digest of its files; `engines.json` beside the page says which versions there are.
 */
import { signal } from '@preact/signals';
import type { EngineClient } from '../../../engine/client';
import type { EngineInfo, Recipe } from '../../../engine/contract';
import { engineInterface } from '../../../engine/interface';
import type { OpenedFiles } from '../../../engine/opened_files';
import { useEngine } from '../../run/engine';
import { defaults, schema } from '../../run/stages';

export interface KeptEngine {
  folder: string;
  interface: number;
}

/** Makes the engine of a folder, which takes over the files that are open. */
export type EngineMaker = (folder: string, files: OpenedFiles) => EngineClient;

/** An engine that is up, and what it says of itself. */
export interface StartedEngine {
  client: EngineClient;
  info: EngineInfo;
  /** Of a kept one. */
  folder: string | null;
}

let listed: Promise<Record<string, KeptEngine>> | undefined;

async function fetchList(): Promise<Record<string, KeptEngine>> {
  const response = await fetch(new URL('engines.json', document.baseURI));
  return response.ok ? ((await response.json()) as Record<string, KeptEngine>) : {};
}

/** The folder of a version that is kept here and that this page can drive. */
export async function folderOf(version: string): Promise<string | null> {
  listed ??= fetchList().catch(() => ({}));
  const found = (await listed)[version];
  const sound = found?.interface === engineInterface && /^assets\/engine-[0-9a-f]{8,}\/$/.test(found.folder);
  return sound ? found.folder : null;
}

/** The engine's own values of what is no part of a recipe are left out. */
function recipeOnly({ schema, defaults }: EngineInfo): EngineInfo {
  const { expected: _, ...recipe } = defaults as Recipe & { expected?: unknown };
  return { schema, defaults: recipe as Recipe };
}

let own: StartedEngine | undefined;
let makeKept: EngineMaker | undefined;

/** The kept engine that works for the page, where it is not the page's own. */
export const keptInUse = signal<{ version: string; folder: string } | null>(null);

/** Starts the page's own engine; with `make`, kept ones can be had beside it. */
export async function startOwn(client: EngineClient, make?: EngineMaker): Promise<void> {
  makeKept = make;
  useEngine(client);
  const info = await client.ready;
  own = { client, info: recipeOnly(info), folder: null };
  workWith(own);
}

/** The engine that a case was made with, where it is kept here; else the page's own. */
export async function engineOf(version: string | undefined): Promise<StartedEngine> {
  if (!own) throw new Error('The engine has not been started.');
  if (!version || version === own.info.schema.version || !makeKept) return own;
  if (version === keptInUse.value?.version) return inUse ?? own;
  const folder = await folderOf(version);
  if (!folder) return own;
  const client = makeKept(folder, own.client.files);
  try {
    const info = await client.ready;
    if (info.schema.version === version) return { client, info: recipeOnly(info), folder };
  } catch {
    // It counts as one that is not here.
  }
  client.close();
  return own;
}

export const ownEngine = (): StartedEngine | undefined => own;

let inUse: StartedEngine | undefined;

/** From now on this engine works for the page. */
export function workWith(next: StartedEngine): void {
  if (next === inUse) return;
  const before = inUse;
  inUse = next;
  useEngine(next.client);
  schema.value = next.info.schema;
  defaults.value = next.info.defaults;
  keptInUse.value = next.folder === null ? null : { version: next.info.schema.version, folder: next.folder };
  if (before && before !== next) release(before);
}

/** Ends an engine that nobody works with. */
export function release(one: StartedEngine): void {
  if (one !== own && one !== inUse) one.client.close();
}
