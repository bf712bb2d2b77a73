import { describe, expect, it } from 'vitest';
import { verdictOf } from './verdict';

const expected = { engine: '0.1.0', digest: 'aa', tets: 1000 };

describe('verdictOf', () => {
  it('says reproduced for the same digest, whatever the engine', () => {
    expect(verdictOf(expected, { engine: '0.1.0', digest: 'aa', tets: 1000 }).mesh).toBe('reproduced');
    expect(verdictOf(expected, { engine: '0.2.0', digest: 'aa', tets: 1000 }).mesh).toBe('reproduced');
  });

  it('says differs for another digest of the same engine, with the numbers', () => {
    const verdict = verdictOf(expected, { engine: '0.1.0', digest: 'bb', tets: 1001 });
    expect(verdict.mesh).toBe('differs');
    expect(verdict.rows.map((row) => row.same)).toEqual([true, false, false]);
  });

  it('says that another engine made it, where that explains the difference', () => {
    expect(verdictOf(expected, { engine: '0.2.0', digest: 'bb', tets: 990 }).mesh).toBe('other_engine');
  });

  it('takes engines of one release for two where their sources differ', () => {
    const promised = { ...expected, engine: '0.2.0+0123456789ab' };
    const verdict = verdictOf(promised, { engine: '0.2.0+0123456789ac', digest: 'bb', tets: 1000 });
    expect(verdict.mesh).toBe('other_engine');
    expect(verdict.rows[0]).toMatchObject({ expected: '0.2.0+0123456789ab', found: '0.2.0+0123456789ac' });
  });

  const wave = { ...expected, physics: '0.2.0+p', stages: { eikonal: '', monodomain: 'ww' } };
  const mesh = { engine: '0.1.0', digest: 'aa', tets: 1000 };

  it('says of a promised wave that it is awaited, reproduced, or differs, beside the mesh', () => {
    expect(verdictOf(expected, mesh).simulation).toBeNull();
    expect(verdictOf(wave, mesh)).toMatchObject({ mesh: 'reproduced', simulation: 'awaited' });
    const found = { ...mesh, physics: '0.2.0+p', stages: { monodomain: 'ww' } };
    expect(verdictOf(wave, found)).toMatchObject({ mesh: 'reproduced', simulation: 'reproduced' });
    const other = { ...found, stages: { monodomain: 'vv' } };
    expect(verdictOf(wave, other)).toMatchObject({ mesh: 'reproduced', simulation: 'differs' });
    expect(
      verdictOf(wave, other)
        .rows.map(({ name, same }) => [name, same])
        .slice(3),
    ).toEqual([
      ['Physics', true],
      ['Digest of the wave', false],
    ]);
  });

  it('blames the physics where that is another, and the engine where the mesh is another', () => {
    const other = { ...mesh, physics: '0.2.0+q', stages: { monodomain: 'vv' } };
    expect(verdictOf(wave, other).simulation).toBe('other_engine');
    const onOtherMesh = { ...other, engine: '0.2.0', digest: 'bb', physics: '0.2.0+p' };
    expect(verdictOf(wave, onOtherMesh)).toMatchObject({ mesh: 'other_engine', simulation: 'other_engine' });
  });
});
