import { afterEach, beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { EngineClient } from '../../../engine/client';
import type { Recipe } from '../../../engine/contract';
import { Workers } from '../../../engine/testing/workers';
import { decodeFragment, encodePlainFragment } from '../../../link/codec';
import {
  acceptOffer,
  closeOffer,
  keepCase,
  offered,
  openAddress,
  openPhantom,
  startEngine,
  undoEdit,
} from '../open_case';
import type { SavedCase } from './autosave';
import { caseId, changedAt, editRecipe, recipe } from '../recipe';
import { expectation, report } from '../../run/report';
import { activity } from '../../run/stages';
import { cancelRun, runAll } from '../../run/run_stages';

/** What the tab before has saved. */
const kept = vi.hoisted(() => ({ saved: null as unknown, interrupted: false }));
vi.mock('./autosave', () => ({
  autosave: () => undefined,
  savedCase: async () => (kept.saved ? { saved: kept.saved, interrupted: kept.interrupted } : null),
}));

/** A browser's history, of entries with an address and a state. */
class Entries {
  list: { hash: string; state: unknown }[] = [{ hash: '', state: null }];
  at = 0;
  changed: () => void = () => undefined;
  get now() {
    return this.list[this.at];
  }
  get state() {
    return this.now.state;
  }
  replaceState(state: unknown, _: string, hash = this.now.hash) {
    this.list[this.at] = { hash, state };
  }
  pushState(state: unknown, _: string, hash: string) {
    this.list = [...this.list.slice(0, ++this.at), { hash, state }];
  }
  /** The user follows a link on the page, or types one into the address bar. */
  visit(hash: string) {
    this.pushState(null, '', hash);
    this.changed();
  }
}

const sphere = { source: { phantom: { kind: 'sphere' } } };
const torus = { source: { phantom: { kind: 'torus' } } };
const edge = (edge_mm: number) => editRecipe('Edge', (draft) => void (draft.sizing.edge_mm = edge_mm));
const later = (ms: number) => new Promise((done) => setTimeout(done, ms));

const entries = new Entries();
let workers: Workers;

const shows = (kind: string, edge_mm: number) =>
  vi.waitFor(async () => {
    const found = (await decodeFragment(entries.now.hash)) as unknown as Recipe;
    expect([found.source.phantom?.kind, found.sizing.edge_mm]).toEqual([kind, edge_mm]);
  }, 5000);

/** The page is opened, or loaded again, at this entry. */
async function load(): Promise<void> {
  workers?.end();
  workers = new Workers();
  offered.value = null;
  expectation.value = null;
  await startEngine(new EngineClient(workers.setup()));
  await openAddress();
}

/** The page is opened by a link, and its case as well. */
async function openLink(value: object): Promise<void> {
  entries.list = [{ hash: encodePlainFragment({ ...value }), state: null }];
  await load();
  acceptOffer(false);
}

beforeAll(() => {
  vi.stubGlobal('history', entries);
  vi.stubGlobal('location', {
    get hash() {
      return entries.now.hash;
    },
  });
  vi.stubGlobal('addEventListener', (_: string, changed: () => void) => (entries.changed = changed));
  keepCase();
});
beforeEach(() => {
  kept.saved = null;
  kept.interrupted = false;
  entries.list = [{ hash: '', state: null }];
  entries.at = 0;
});
afterEach(async () => {
  await cancelRun();
  workers.end();
});

describe('the address bar', () => {
  it('keeps the link that brought a case, on the same entry of the history', async () => {
    await openLink(torus);
    await shows('torus', 2);
    expect(entries.list).toHaveLength(1);
  });

  it('follows every edit, undo too, without a new entry', async () => {
    await openLink(torus);
    edge(3);
    await shows('torus', 3);
    edge(4);
    await shows('torus', 4);
    await undoEdit();
    await shows('torus', 3);
    expect(entries.list).toHaveLength(1);
  });

  it('is written once for edits in quick succession', async () => {
    await openLink(torus);
    await shows('torus', 2);
    const write = vi.spyOn(entries, 'replaceState');
    for (const size of [3, 4, 5, 6]) {
      edge(size);
      await later(50);
    }
    await shows('torus', 6);
    expect(write).toHaveBeenCalledTimes(1);
    write.mockRestore();
  });

  it('keeps a link that is not opened now, and asks again after a reload', async () => {
    const hash = encodePlainFragment(torus);
    entries.list = [{ hash, state: null }];
    await load();
    closeOffer();
    await later(600);
    expect(entries.list).toEqual([{ hash, state: null }]);
    await load();
    expect(offered.value?.recipe.source.phantom?.kind).toBe('torus');
  });

  it('goes back to the open case where another link is not opened, which stays one step back', async () => {
    await openLink(torus);
    await shows('torus', 2);
    const other = encodePlainFragment(sphere);
    entries.visit(other);
    await vi.waitFor(() => expect(offered.value).not.toBeNull());
    await later(600);
    expect(entries.now.hash).toBe(other);
    closeOffer();
    await shows('torus', 2);
    expect(entries.list.map(({ hash }) => hash).slice(-2)[0]).toBe(other);
  });

  it('is mended after a damaged link, which the case outlives', async () => {
    await openLink(torus);
    await shows('torus', 2);
    entries.visit('#c1=abc');
    await shows('torus', 2);
  });

  it('gives another case an entry of its own, so that the one before is a step back', async () => {
    await openLink(torus);
    await shows('torus', 2);
    await openPhantom({ kind: 'sphere' });
    await shows('sphere', 2);
    entries.at = 0;
    await shows('torus', 2);
  });

  it('holds name and digest of a file, and goes on to wait for it', async () => {
    const file = { name: 'heart.nii', sha256: 'ab'.repeat(32) };
    await openLink({ source: { file } });
    await vi.waitFor(() => expect(entries.now.state).not.toBeNull());
    edge(3);
    await vi.waitFor(async () =>
      expect(await decodeFragment(entries.now.hash)).toMatchObject({
        source: { file },
        sizing: { edge_mm: 3 },
      }),
    );
  });

  it('promises nothing of its own: after an update the engine may make another mesh', async () => {
    await load();
    await openPhantom({ kind: 'torus' });
    await vi.waitFor(() => expect(activity.value).toBe('idle'), 5000);
    await runAll();
    expect(report.value).not.toBeNull();
    edge(3);
    await undoEdit();
    await shows('torus', 2);
    expect((await decodeFragment(entries.now.hash)).expected).toBeUndefined();
  });

  it("hands on the link's promise while the recipe is the promised one", async () => {
    const expected = { engine: '0.1.0', digest: 'ab'.repeat(32), tets: 5 };
    const promised = async () => (await decodeFragment(entries.now.hash)).expected;
    await openLink({ ...torus, expected });
    edge(3);
    await shows('torus', 3);
    expect(await promised()).toBeUndefined();
    await undoEdit();
    await shows('torus', 2);
    expect(await promised()).toEqual(expected);
  });
});

describe('a page that is loaded again', () => {
  /** What the autosave would hold of the case that is open. */
  const saved = (id = caseId.value): SavedCase => ({
    id,
    recipe: recipe.value as Recipe,
    changedAt: changedAt.value,
    promise: null,
    sides: [],
    file: null,
  });

  it('goes on with its own case without a question', async () => {
    await openLink(torus);
    edge(3);
    await shows('torus', 3);
    kept.saved = saved();
    await load();
    expect(offered.value).toBeNull();
    expect(recipe.value?.sizing.edge_mm).toBe(3);
    await shows('torus', 3);
    expect(entries.list).toHaveLength(1);
  });

  it('goes on with the later of the link and what is saved', async () => {
    await openLink(torus);
    edge(3);
    await shows('torus', 3);
    kept.saved = saved();
    edge(4);
    await shows('torus', 4);
    await load();
    expect(recipe.value?.sizing.edge_mm).toBe(4);
    expect(offered.value).toBeNull();
    edge(5);
    kept.saved = saved();
    await load();
    expect(recipe.value?.sizing.edge_mm).toBe(5);
  });

  it('goes on with its own case though another tab has saved another since', async () => {
    await openLink(torus);
    edge(3);
    await shows('torus', 3);
    kept.saved = { ...saved('of another tab'), recipe: { ...recipe.value, ...sphere } as unknown as Recipe };
    await load();
    expect(offered.value).toBeNull();
    expect(recipe.value?.source.phantom?.kind).toBe('torus');
    expect(recipe.value?.sizing.edge_mm).toBe(3);
    expect(entries.list).toHaveLength(1);
  });

  it('asks where the engine was at work on the case', async () => {
    await openLink(torus);
    await shows('torus', 2);
    kept.saved = saved();
    kept.interrupted = true;
    await load();
    expect(offered.value?.origin).toBe('interrupted');
  });

  it('asks about a link from elsewhere, though a case is saved', async () => {
    await openLink(torus);
    kept.saved = saved();
    entries.list = [{ hash: encodePlainFragment(sphere), state: null }];
    await load();
    expect(offered.value?.origin).toBe('link');
    expect(offered.value?.recipe.source.phantom?.kind).toBe('sphere');
  });

  it('does not ask about a bookmark of the case that is saved', async () => {
    await openLink(torus);
    await shows('torus', 2);
    kept.saved = saved();
    entries.list = [{ hash: entries.now.hash, state: null }];
    await load();
    expect(offered.value).toBeNull();
  });
});
