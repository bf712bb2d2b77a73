import { ROCrate } from 'ro-crate';
import { describe, expect, it } from 'vitest';
import type { Report } from '../engine/contract';
import createVoxtet from '../engine/testing/mock_engine.mjs';
import { mediaTypeOf, roCrate } from './ro_crate';

async function report(): Promise<Report> {
  const session = new (await createVoxtet()).Session();
  session.setRecipe(JSON.stringify({ source: { phantom: {} } }));
  session.begin('quality');
  session.advance(Infinity, () => undefined);
  return JSON.parse(session.report()) as Report;
}

const bytes = new TextEncoder().encode('abc');
const sha256 = 'ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad';

describe('a research object', () => {
  it('describes every file, and the run that made them, as its readers expect', async () => {
    const files = ['heart.vtu', 'heart.case.json', 'scar.nii'].map((path) => ({
      path,
      description: `about ${path}`,
      format: mediaTypeOf(path),
      bytes,
      isInput: path !== 'heart.vtu',
    }));
    const found = await report();
    const at = new Date('2026-01-02T03:04:05Z');
    const context = { title: 'heart', link: 'https://example.org/#c1=abc', at };
    const json = await roCrate(found, files, context);
    const crate = new ROCrate(json, { array: true, link: true });
    const root = crate.rootDataset;
    expect(root.hasPart.map((part: { name: string[] }) => part.name[0])).toEqual([
      'heart.vtu',
      'heart.case.json',
      'scar.nii',
    ]);
    expect(root.hasPart[0].sha256).toEqual([sha256]);
    const [run] = root.mentions;
    expect(run.instrument[0].softwareVersion).toEqual([found.engine]);
    expect(run.object[2].identifier[0].value).toEqual([found.source.digest]);
    expect(run.result[0].name).toEqual(['heart.vtu']);
    // Nothing points to what is not there.
    const ids = new Set((json as { '@graph': { '@id': string }[] })['@graph'].map((one) => one['@id']));
    const references = [...JSON.stringify(json).matchAll(/\{"@id":"([^"]+)"\}/g)].map(([, id]) => id);
    expect(references.length).toBeGreaterThan(8);
    for (const id of references)
      if (!id.startsWith('https://w3id.org/ro/crate/1.1')) expect(ids).toContain(id);
  });
});
