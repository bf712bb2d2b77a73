import { promisedStages, type Expected, type Report } from '../engine/contract';

export type VerdictKind = 'reproduced' | 'differs' | 'other_engine';

export interface Verdict {
  mesh: VerdictKind;
  /** Of what was simulated on the mesh: `awaited` where that has not been done yet, null where nothing is promised. */
  simulation: VerdictKind | 'awaited' | null;
  rows: { name: string; expected: string; found: string; same: boolean }[];
}

/** What a run has given: of its simulations those that are of the promised physics. */
export interface Found extends Pick<Report, 'engine' | 'digest' | 'tets'> {
  physics?: string;
  stages?: Partial<Record<(typeof promisedStages)[number], string>>;
}

const titles = {
  eikonal: 'Digest of the activation map',
  monodomain: 'Digest of the wave',
  mechanics: 'Digest of the heartbeat',
};

/** The stages whose results are promised. */
export function stagesPromised({ stages }: Expected): (typeof promisedStages)[number][] {
  return promisedStages.filter((name) => stages?.[name]);
}

/**
 * What a link promised against what this run gave. Engines are the same only where their whole versions are: release
 * and digest of their sources.
 */
export function verdictOf(expected: Expected, found: Found): Verdict {
  const row = (name: string, promised: string, got: string) => ({
    name,
    expected: promised,
    found: got,
    same: promised === got,
  });
  const rows = [
    row('Engine', expected.engine, found.engine),
    row('Tetrahedra', expected.tets.toLocaleString('en'), found.tets.toLocaleString('en')),
    row('Digest', expected.digest, found.digest),
  ];
  const sameMesh = expected.digest === found.digest;
  const otherEngine = expected.engine !== found.engine;
  const mesh = sameMesh ? 'reproduced' : otherEngine ? 'other_engine' : 'differs';
  const promised = stagesPromised(expected);
  if (promised.length === 0) return { mesh, simulation: null, rows };
  const digests = promised.map((name) =>
    row(titles[name], expected.stages?.[name] ?? '', found.stages?.[name] ?? ''),
  );
  if (digests.some((one) => one.found === '')) return { mesh, simulation: 'awaited', rows };
  rows.push(row('Physics', expected.physics ?? '', found.physics ?? ''), ...digests);
  const same = digests.every((one) => one.same);
  const other = otherEngine || (expected.physics ?? found.physics) !== found.physics;
  return { mesh, simulation: same ? 'reproduced' : other ? 'other_engine' : 'differs', rows };
}
