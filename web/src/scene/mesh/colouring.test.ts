import { afterEach, describe, expect, it } from 'vitest';
import { tetMeasures, type StageArrays, type VolumeSummary } from '../../engine/contract';
import { volume } from '../../store/case/input';
import { colourBy } from '../../store/view';
import { tetPaint } from './colouring';

const measures = Object.fromEntries(
  tetMeasures.map((name) => [name, Float32Array.from({ length: 100 }, (_, i) => i / 100)]),
) as StageArrays['quality'];
measures.edge_mm.fill(3);
measures.size_log2.fill(-1).fill(0.25, 50);

describe('colours of tetrahedra', () => {
  afterEach(() => void (colourBy.value = 'label'));

  it('are those of labels until there are measures', () => {
    colourBy.value = 'radius_ratio';
    expect(tetPaint(undefined).kind).toBe('label');
    expect(tetPaint(measures).kind).toBe('scale');
  });

  it('tell the target edge length from the edge length and their ratio', () => {
    colourBy.value = 'target_mm';
    const paint = tetPaint(measures);
    expect(paint.kind === 'scale' && [paint.values[0], paint.legend.unit]).toEqual([6, 'mm']);
  });

  it('have ratios around nothing in the middle of their scale', () => {
    colourBy.value = 'size_log2';
    const paint = tetPaint(measures);
    expect(paint.kind === 'scale' && [paint.legend.lo, paint.legend.hi]).toEqual([-1, 1]);
  });

  it('follow the labels that were looked up, and shares from nothing to all', () => {
    const looked = { ...measures, majority_label: measures.radius_ratio, fraction_5: measures.radius_ratio };
    colourBy.value = 'majority_label';
    expect(tetPaint(looked).kind).toBe('given');
    colourBy.value = 'fraction_5';
    const paint = tetPaint(looked);
    expect(paint.kind === 'scale' && [paint.legend.lo, paint.legend.hi]).toEqual([0, 1]);
  });

  it('show layers from the fewest to the most, and nothing where there is no wall', () => {
    const layer = Float32Array.from([-1, 1, 3, 2]);
    colourBy.value = 'layer';
    const paint = tetPaint({ ...measures, layer });
    expect(paint.kind === 'parts' && paint.legend).toMatchObject({ lo: 1, hi: 3, whole: true });
    colourBy.value = 'layers_across';
    const same = tetPaint({ ...measures, layer, layers_across: Float32Array.from([-1, 3, 3, 3]) });
    expect(same.kind === 'parts' && same.legend).toMatchObject({ lo: 2, hi: 4 });
    expect(tetPaint(measures).kind).toBe('label');
  });

  it('show distances to the labels from nothing up, in millimetres or voxels, and none inside', () => {
    const distance_mm = Float32Array.from([-1, 0, 1, 2]);
    volume.value = { spacing_mm: [0.5, 2, 2] } as VolumeSummary;
    for (const [by, unit, hi] of [
      ['distance_mm', 'mm', 2],
      ['distance_voxels', 'voxels', 4],
    ] as const) {
      colourBy.value = by;
      const paint = tetPaint({ ...measures, distance_mm });
      expect(paint.kind === 'points' && [...paint.values]).toEqual([-1, 0, hi / 2, hi]);
      expect(paint.kind === 'points' && paint.legend).toMatchObject({ unit, lo: 0, hi });
    }
  });
});
