/** The tab's case in IndexedDB, so that a reload loses nothing. One case: the last one edited. */
import { effect } from '@preact/signals';
import type { Expected, Recipe, VolumeFile } from '../engine/contract';
import { recipe } from './recipe';
import { activity, expectation } from './run';
import { heldSides, type SideFile } from './side_files';
import { ownColours } from './view';

export interface SavedCase {
  recipe: Recipe;
  expected: Expected | null;
  /** Of labels, where they are the user's own. */
  colours: Readonly<Record<number, string>>;
  /** Masks and images of sizes. */
  sides: SideFile[];
  /** Bytes of the volume, for a file source. */
  file: VolumeFile | null;
}

const storeName = 'case';
const busyKey = 'voxtet-busy';
const delayMs = 600;

function openDatabase(): Promise<IDBDatabase> {
  return new Promise((opened, failed) => {
    const request = indexedDB.open('voxtet', 1);
    request.onupgradeneeded = () => request.result.createObjectStore(storeName);
    request.onsuccess = () => opened(request.result);
    request.onerror = () => failed(request.error);
  });
}

async function transact<T>(
  mode: IDBTransactionMode,
  body: (store: IDBObjectStore) => IDBRequest<T>,
): Promise<T> {
  const database = await openDatabase();
  try {
    return await new Promise<T>((done, failed) => {
      const transaction = database.transaction(storeName, mode);
      const request = body(transaction.objectStore(storeName));
      transaction.oncomplete = () => done(request.result);
      transaction.onabort = () => failed(transaction.error);
    });
  } finally {
    database.close();
  }
}

/** The saved case, and whether the engine was at work when the page was left. */
export async function savedCase(): Promise<{ saved: SavedCase; interrupted: boolean } | null> {
  const interrupted = localStorage.getItem(busyKey) !== null;
  localStorage.removeItem(busyKey);
  const [kept, file, sides] = await Promise.all([
    transact<Omit<SavedCase, 'file' | 'sides'> | undefined>('readonly', (store) => store.get('recipe')),
    transact<{ digest: string; file: VolumeFile } | undefined>('readonly', (store) => store.get('file')),
    transact<SideFile[] | undefined>('readonly', (store) => store.get('sides')),
  ]);
  if (!kept) return null;
  const digest = kept.recipe.source.file?.sha256;
  if (kept.recipe.source.file && file?.digest !== digest) return null;
  // What an earlier version kept has no colours.
  const { colours = {} } = kept as Partial<typeof kept>;
  const saved = { ...kept, colours, file: digest && file ? file.file : null, sides: sides ?? [] };
  return { saved, interrupted };
}

/** Saves every change from now on. Where the browser allows no storage, the tab works all the same. */
export function autosave(fileOf: (digest: string) => VolumeFile | undefined): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let savedFile = '';
  let savedSides = '';
  const saveSides = async () => {
    const sides = heldSides();
    const digests = sides.map(({ kind, digest }) => kind + digest).join();
    if (digests === savedSides) return;
    await transact('readwrite', (store) => store.put(sides, 'sides'));
    savedSides = digests;
  };
  const save = async (kept: Omit<SavedCase, 'file' | 'sides'>) => {
    const { recipe: current } = kept;
    const digest = current.source.file?.sha256;
    const file = digest ? fileOf(digest) : undefined;
    if (digest && !file) return;
    if (digest && file && digest !== savedFile) {
      await transact('readwrite', (store) => store.put({ digest, file }, 'file'));
      savedFile = digest;
    }
    await saveSides();
    await transact('readwrite', (store) => store.put(kept, 'recipe'));
  };
  effect(() => {
    const current = recipe.value;
    const expected = expectation.value?.expected ?? null;
    const colours = ownColours.value;
    clearTimeout(timer);
    if (!current || !(current.source.phantom || current.source.file)) return;
    timer = setTimeout(
      () => void save({ recipe: current, expected, colours }).catch(() => undefined),
      delayMs,
    );
  });
  effect(() => {
    if (activity.value === 'idle' || activity.value === 'starting') localStorage.removeItem(busyKey);
    else localStorage.setItem(busyKey, activity.value);
  });
}
