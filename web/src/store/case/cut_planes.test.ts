import { describe, expect, it } from 'vitest';
import { volume } from './input';
import { acrossSlice, newCut, surfaceName, turned, type CutPlane } from './cut_planes';

const plane = (name: string): CutPlane => ({ name, labels: [], point_mm: [0, 0, 0], normal: [0, 0, 1] });

describe('planes that cut', () => {
  it('are named as the engine names them', () => {
    const cuts = [plane('base'), plane(''), plane('cut_2'), plane('')];
    expect(cuts.map((_, index) => surfaceName(cuts, index))).toEqual(['base', 'cut', 'cut_2', 'cut_3']);
  });

  it('are called base once', () => {
    expect(newCut([], [0, 0, 0]).name).toBe('base');
    expect(newCut([plane('base')], [0, 0, 0]).name).toBe('');
  });

  it('lie across the slices of an oblique image, away from the feet', () => {
    expect(acrossSlice('coronal')).toEqual([0, 1, 0]);
    const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
    const before = volume.value;
    volume.value = {
      ...(before as object),
      size: [10, 10, 10],
      // The third axis leads to the feet, tilted to the front.
      index_to_mm: [1, 0, 0, 0, 0, c, s, 0, 0, s, -c, 0, 0, 0, 0, 1],
    } as typeof volume.value;
    const across = acrossSlice('axial');
    expect(across[2]).toBeCloseTo(c, 3);
    expect(across[1]).toBeCloseTo(-s, 3);
    volume.value = before;
  });

  it('can be turned round', () => {
    expect(turned([0, 0.6, -0.8])).toEqual([0, -0.6, 0.8]);
  });
});
