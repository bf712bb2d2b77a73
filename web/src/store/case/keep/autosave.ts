/** The tab's case in IndexedDB, so that a reload loses nothing. One case: the last one edited. */
import { effect } from '@preact/signals';
import type { Recipe, VolumeFile } from '../../../engine/contract';
import { caseId, changedAt, hasSource, recipe } from '../recipe';
import { expectation, type Expectation } from '../../run/report';
import { activity } from '../../run/stages';
import { heldSides, type SideFile } from '../side_files';
import { keepText, keptText } from './web_storage';

export interface SavedCase {
  /** The name of the case, as the browser's history has it. */
  id: string;
  recipe: Recipe;
  changedAt: number;
  promise: Expectation | null;
  /** Masks and images of sizes. */
  sides: SideFile[];
  /** Bytes of the volume, where the recipe's source is a file and it was at hand. */
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

/** The saved case, and whether the engine was at work when this tab left the page. */
export async function savedCase(): Promise<{ saved: SavedCase; interrupted: boolean } | null> {
  const interrupted = keptText('sessionStorage', busyKey) !== null;
  keepText('sessionStorage', busyKey, null);
  const [kept, file, sides] = await Promise.all([
    transact<Omit<SavedCase, 'file' | 'sides'> | undefined>('readonly', (store) => store.get('recipe')),
    transact<{ digest: string; file: VolumeFile } | undefined>('readonly', (store) => store.get('file')),
    transact<SideFile[] | undefined>('readonly', (store) => store.get('sides')),
  ]);
  if (!kept) return null;
  const digest = kept.recipe.source.file?.sha256;
  // What an earlier version kept has none of these.
  const { id = '', changedAt = 0, promise = null } = kept as Partial<typeof kept>;
  const own = digest && file?.digest === digest ? file.file : null;
  return { saved: { ...kept, id, changedAt, promise, file: own, sides: sides ?? [] }, interrupted };
}

/** Saves every change from now on. Where the browser allows no storage, the tab works all the same. */
export function autosave(fileOf: (digest: string) => VolumeFile | undefined): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const tab = Math.random().toString(36).slice(2);
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
    // Another tab may have put its own case in this one's place, files and all.
    if ((await transact<unknown>('readonly', (store) => store.get('tab'))) !== tab) {
      savedFile = savedSides = '';
      await transact('readwrite', (store) => store.put(tab, 'tab'));
    }
    // First: a file too large for the browser's quota is asked for again, the recipe could not be.
    await transact('readwrite', (store) => store.put(kept, 'recipe'));
    await saveSides();
    const digest = kept.recipe.source.file?.sha256;
    const file = digest ? fileOf(digest) : undefined;
    if (!digest || !file || digest === savedFile) return;
    await transact('readwrite', (store) => store.put({ digest, file }, 'file'));
    savedFile = digest;
  };
  effect(() => {
    const current = recipe.value;
    const id = caseId.value;
    const changed = changedAt.value;
    const promise = expectation.value;
    clearTimeout(timer);
    if (!current || !hasSource(current)) return;
    timer = setTimeout(
      () => void save({ id, recipe: current, changedAt: changed, promise }).catch(() => undefined),
      delayMs,
    );
  });
  effect(() => {
    const atRest = activity.value === 'idle' || activity.value === 'starting';
    keepText('sessionStorage', busyKey, atRest ? null : activity.value);
  });
}
