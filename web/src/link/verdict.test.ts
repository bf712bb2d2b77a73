import { describe, expect, it } from 'vitest';
import { verdictOf } from './verdict';

const expected = { engine: '0.1.0', digest: 'aa', tets: 1000 };

describe('verdictOf', () => {
  it('says reproduced for the same digest, whatever the engine', () => {
    expect(verdictOf(expected, { engine: '0.1.0', digest: 'aa', tets: 1000 }).kind).toBe('reproduced');
    expect(verdictOf(expected, { engine: '0.2.0', digest: 'aa', tets: 1000 }).kind).toBe('reproduced');
  });

  it('says differs for another digest of the same engine, with the numbers', () => {
    const verdict = verdictOf(expected, { engine: '0.1.0', digest: 'bb', tets: 1001 });
    expect(verdict.kind).toBe('differs');
    expect(verdict.rows.map((row) => row.same)).toEqual([true, false, false]);
  });

  it('says that another engine made it, where that explains the difference', () => {
    expect(verdictOf(expected, { engine: '0.2.0', digest: 'bb', tets: 990 }).kind).toBe('other_engine');
  });

  it('takes engines of one release for two where their sources differ', () => {
    const promised = { ...expected, engine: '0.2.0+0123456789ab' };
    const verdict = verdictOf(promised, { engine: '0.2.0+0123456789ac', digest: 'bb', tets: 1000 });
    expect(verdict.kind).toBe('other_engine');
    expect(verdict.rows[0]).toMatchObject({ expected: '0.2.0+0123456789ab', found: '0.2.0+0123456789ac' });
  });
});
