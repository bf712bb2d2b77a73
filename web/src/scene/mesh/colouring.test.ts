import { afterEach, describe, expect, it } from 'vitest';
import type { FieldInfo, Report, StageArrays } from '../../engine/contract';
import { colourStops } from '../../geometry/colours';
import { colourBy } from '../../store/view';
import { report } from '../../store/run/report';
import { forgetFound, forgetFrames, keepFound, keepFrame } from '../../store/run/frames';
import { bandEnds, roundEnds, simulatedPaint, tetPaint } from './colouring';

function field(name: string, values: Float32Array, told: Partial<FieldInfo> = {}): StageArrays['quality'] {
  const info = { name, title: name, unit: '1', on: 'tets', scale: 'sequential', components: 1 } as const;
  return { fields: [{ ...info, count: values.length, range: null, ...told }], values: { [name]: values } };
}
const parts = Float32Array.from({ length: 100 }, (_, i) => i / 100);

describe('colours of tetrahedra', () => {
  afterEach(() => void (colourBy.value = 'label'));

  it('are those of labels until there are measures', () => {
    colourBy.value = 'radius_ratio';
    expect(tetPaint(undefined).kind).toBe('label');
    expect(tetPaint(field('mean_ratio', parts)).kind).toBe('label');
    expect(tetPaint(field('radius_ratio', parts)).kind).toBe('scale');
  });

  it('have the title and unit that the engine gives, whatever the field', () => {
    colourBy.value = 'a_new_measure';
    const paint = tetPaint(field('a_new_measure', parts, { title: 'A new measure', unit: 'deg' }));
    expect(paint.kind === 'scale' && paint.legend).toMatchObject({ title: 'A new measure', unit: '°' });
  });

  it('are loud at the bad end of what elements are ranked by, whichever that is', () => {
    for (const [worst, map] of [
      [0, 'alarm_low'],
      [99, 'alarm'],
    ] as const) {
      const metrics = [{ name: 'radius_ratio', elements: 'tets', worst: [worst], median: 0.5 }];
      report.value = { quality: { metrics } } as unknown as Report;
      colourBy.value = 'radius_ratio';
      expect(tetPaint(field('radius_ratio', parts))).toMatchObject({ legend: { map } });
      colourBy.value = 'edge_mm';
      expect(tetPaint(field('edge_mm', parts, { unit: 'mm' }))).toMatchObject({ legend: { map: 'viridis' } });
    }
    report.value = null;
  });

  it('have ratios around nothing in the middle of their scale', () => {
    colourBy.value = 'size_log2';
    const ratios = new Float32Array(100).fill(-1).fill(0.25, 50);
    const paint = tetPaint(field('size_log2', ratios, { scale: 'diverging', unit: 'log2' }));
    expect(paint.kind === 'scale' && [paint.legend.lo, paint.legend.hi]).toEqual([-1, 1]);
  });

  it('follow the labels that were transferred, and shares from nothing to all', () => {
    colourBy.value = 'majority_label';
    expect(tetPaint(field('majority_label', parts, { scale: 'label' })).kind).toBe('given');
    colourBy.value = 'fraction_5';
    const paint = tetPaint(field('fraction_5', parts));
    expect(paint.kind === 'scale' && [paint.legend.lo, paint.legend.hi]).toEqual([0, 1]);
  });

  it('show layers from the fewest to the most, and nothing where there is no wall', () => {
    colourBy.value = 'layer';
    const paint = tetPaint(field('layer', Float32Array.from([-1, 1, 3, 2]), { scale: 'whole' }));
    expect(paint.kind === 'parts' && paint.legend).toMatchObject({ lo: 1, hi: 3, whole: true });
    const same = tetPaint(field('layer', Float32Array.from([-1, 3, 3, 3]), { scale: 'whole' }));
    expect(same.kind === 'parts' && same.legend).toMatchObject({ lo: 3, hi: 3 });
  });

  it('show values of points from nothing up, and none inside', () => {
    colourBy.value = 'distance_mm';
    const distances = Float32Array.from([-1, 0, 1, 2]);
    const paint = tetPaint(field('distance_mm', distances, { on: 'points', unit: 'mm' }));
    expect(paint.kind === 'points' && [...paint.values]).toEqual([-1, 0, 1, 2]);
    expect(paint.kind === 'points' && paint.legend).toMatchObject({ unit: 'mm', lo: 0, hi: 2 });
  });
});

describe('colours of what is played', () => {
  afterEach(() => {
    colourBy.value = 'label';
    forgetFrames();
  });

  it('go on between points, on one scale in round numbers', () => {
    const { fields } = field('temperature', parts, { on: 'points', range: [-0.005, 1] });
    keepFrame({ timeMs: 0, fields, values: { temperature: parts } });
    expect(simulatedPaint()).toBeNull();
    colourBy.value = 'temperature';
    expect(simulatedPaint()).toMatchObject({ kind: 'nodal', values: parts, legend: { lo: 0, hi: 1 } });
  });

  it('are those of nearly all elements where a few are far beyond them', () => {
    const strains = Float32Array.from({ length: 1000 }, (_, i) => (i === 7 ? 300 : (i % 41) - 20));
    const range: [number, number] = [-20, 300];
    const { fields } = field('strain', strains, { unit: '%', scale: 'diverging', range });
    keepFrame({ timeMs: 0, fields, values: { strain: strains } });
    colourBy.value = 'strain';
    expect(simulatedPaint()).toMatchObject({ legend: { lo: -20, hi: 20, values: range } });
  });

  it('go around a circle where it is a phase, in words', () => {
    const { fields } = field('voltage_mV', parts, { on: 'points', range: [-80, 20] });
    keepFrame({ timeMs: 0, fields, values: { voltage_mV: parts } });
    colourBy.value = 'phase_deg';
    expect(simulatedPaint()).toMatchObject({
      kind: 'nodal',
      legend: { title: 'Phase', map: 'cycle', lo: -180, hi: 180 },
    });
    const [first, last] = [colourStops('cycle')[0], colourStops('cycle').at(-1)];
    expect(first).toBe(last);
  });

  it.each([
    [-87.3, 41.2, -85, 40],
    [0, 137.2, 0, 135],
    [3, 3, 3, 4],
  ])('from %f to %f have ends at %f and %f', (least, most, lo, hi) => {
    expect(roundEnds([least, most])).toEqual({ lo, hi });
  });
});

describe('colours of what a simulation found', () => {
  afterEach(() => {
    colourBy.value = 'label';
    forgetFound();
  });

  it('are bands of round numbers where it is a time', () => {
    const { fields } = field('activation_ms', parts, { on: 'points', unit: 'ms', range: [0, 137] });
    keepFound({ fields, values: { activation_ms: parts } });
    colourBy.value = 'activation_ms';
    expect(simulatedPaint()).toMatchObject({
      kind: 'nodal',
      values: parts,
      legend: { unit: 'ms', bands: 20 },
    });
  });

  it('have 0 in their middle where they go both ways', () => {
    const info = { unit: '%', scale: 'diverging', range: [-9, 2] } as const;
    const { fields } = field('speed_error_percent', parts, { ...info, range: [...info.range] });
    keepFound({ fields, values: { speed_error_percent: parts } });
    colourBy.value = 'speed_error_percent';
    expect(simulatedPaint()).toMatchObject({ kind: 'scale', legend: { lo: -9, hi: 9 } });
  });

  it.each([
    [0, 60, 5],
    [0, 135, 20],
    [10, 22, 1],
    [0, 1, 0.1],
  ])('from %f to %f are %f wide', (lo, hi, width) => expect(bandEnds([lo, hi]).bands).toBeCloseTo(width));
});
