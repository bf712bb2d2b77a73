import type { Expected, Report } from '../engine/contract';

export type VerdictKind = 'reproduced' | 'differs' | 'other_engine';

export interface Verdict {
  kind: VerdictKind;
  rows: { name: string; expected: string; found: string; same: boolean }[];
}

/**
 * What a link promised against what this run gave. Engines are the same only where their whole versions are: release
 * and digest of their sources.
 */
export function verdictOf(expected: Expected, report: Pick<Report, 'engine' | 'digest' | 'tets'>): Verdict {
  const row = (name: string, promised: string, found: string) => ({
    name,
    expected: promised,
    found,
    same: promised === found,
  });
  const rows = [
    row('Engine', expected.engine, report.engine),
    row('Tetrahedra', expected.tets.toLocaleString('en'), report.tets.toLocaleString('en')),
    row('Digest', expected.digest, report.digest),
  ];
  const same = expected.digest === report.digest;
  return { kind: same ? 'reproduced' : expected.engine !== report.engine ? 'other_engine' : 'differs', rows };
}
