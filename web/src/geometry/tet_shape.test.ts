import { expect, it } from 'vitest';
import { flattenedTet, measureTet } from './tet_shape';

it('gives 1 and 70.53 degrees for the regular tetrahedron', () => {
  const shape = measureTet(flattenedTet(0));
  for (const angle of shape.dihedral) expect(angle).toBeCloseTo(70.5288, 4);
  for (const edge of shape.edges) expect(edge).toBeCloseTo(2, 12);
  for (const ratio of [shape.radiusRatio, shape.meanRatio, shape.aspectRatio, shape.scaledJacobian])
    expect(ratio).toBeCloseTo(1, 12);
});

it('gives the corner of a cube its known measures', () => {
  const shape = measureTet([
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ]);
  const right = shape.dihedral.filter((angle) => Math.abs(angle - 90) < 1e-9);
  expect(right).toHaveLength(3);
  expect(Math.min(...shape.dihedral)).toBeCloseTo((Math.acos(1 / Math.sqrt(3)) * 180) / Math.PI, 9);
  expect(shape.circumscribed.radius).toBeCloseTo(Math.sqrt(3) / 2, 12);
  expect(shape.circumscribed.centre.map((x) => Number(x.toFixed(12)))).toEqual([0.5, 0.5, 0.5]);
  const inradius = 1 / (3 + Math.sqrt(3));
  expect(shape.inscribed.radius).toBeCloseTo(inradius, 12);
  expect(shape.inscribed.centre[0]).toBeCloseTo(inradius, 12);
  expect(shape.radiusRatio).toBeCloseTo((3 * inradius * 2) / Math.sqrt(3), 12);
  expect(shape.scaledJacobian).toBeCloseTo(Math.SQRT2 / 2, 12);
});

it('grows worse by every measure as it is flattened', () => {
  let last = measureTet(flattenedTet(0));
  for (const flatness of [0.2, 0.4, 0.6, 0.8, 0.95]) {
    const next = measureTet(flattenedTet(flatness));
    expect(next.radiusRatio).toBeLessThan(last.radiusRatio);
    expect(next.meanRatio).toBeLessThan(last.meanRatio);
    expect(next.aspectRatio).toBeGreaterThan(last.aspectRatio);
    expect(next.scaledJacobian).toBeLessThan(last.scaledJacobian);
    expect(Math.min(...next.dihedral)).toBeLessThan(Math.min(...last.dihedral));
    last = next;
  }
});
