import { describe, expect, it } from 'vitest';
import { spectrumOf } from './stiffness';

const mesh = (points: number[][], tets: number[][]) => ({
  points: Float32Array.from(points.flat()),
  tets: Uint32Array.from(tets.flat()),
});

/** A square of side s whose corners are lifted and lowered by epsilon. */
const sliver = (s: number, epsilon: number) =>
  mesh(
    [
      [0, 0, epsilon],
      [s, 0, -epsilon],
      [s, s, epsilon],
      [0, s, -epsilon],
    ],
    [[0, 1, 2, 3]],
  );

/** A box of n³ cubes with sides h, each cut into six tetrahedra along its diagonal. */
function box(n: number, h: number) {
  const points: number[][] = [];
  const at = (x: number, y: number, z: number) => x + (n + 1) * (y + (n + 1) * z);
  for (let z = 0; z <= n; z++)
    for (let y = 0; y <= n; y++) for (let x = 0; x <= n; x++) points.push([h * x, h * y, h * z]);
  const ways = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
  ];
  const tets: number[][] = [];
  for (let z = 0; z < n; z++)
    for (let y = 0; y < n; y++)
      for (let x = 0; x < n; x++)
        for (const way of ways) {
          const corner = [x, y, z];
          const tet = [at(x, y, z)];
          for (const axis of way) {
            corner[axis]++;
            tet.push(at(corner[0], corner[1], corner[2]));
          }
          tets.push(tet);
        }
  return mesh(points, tets);
}

describe('the spectrum of a stiffness matrix', () => {
  it('is that of the closed form for a regular tetrahedron: three times edge / (3 √2)', () => {
    const half = 3 / Math.SQRT2 / 2;
    const corners = [
      [1, 1, 1],
      [1, -1, -1],
      [-1, 1, -1],
      [-1, -1, 1],
    ].map((corner) => corner.map((x) => half * x));
    const found = spectrumOf(mesh(corners, [[0, 1, 2, 3]]))!;
    expect(found.largest).toBeCloseTo(3 / (3 * Math.SQRT2), 5);
    expect(found.condition).toBeCloseTo(1, 5);
  });

  it.each([
    [4, 0.4],
    [4, 0.1],
    [1, 0.01],
  ])('has s² / (6 ε) as its largest eigenvalue for a sliver, s = %s and ε = %s', (s, epsilon) => {
    expect(spectrumOf(sliver(s, epsilon))!.largest / (s ** 2 / (6 * epsilon))).toBeCloseTo(1, 4);
  });

  it('scales with lengths, and leaves the condition number', () => {
    const [one, two] = [spectrumOf(box(3, 1))!, spectrumOf(box(3, 2))!];
    expect(two.largest / one.largest).toBeCloseTo(2, 4);
    expect(two.smallest / one.smallest).toBeCloseTo(2, 4);
    expect(two.condition / one.condition).toBeCloseTo(1, 4);
  });

  it('comes close to that of the body for a fine mesh: the smallest over h³ to (π / length)²', () => {
    const n = 12;
    const found = spectrumOf(box(n, 1 / n))!;
    // Points of the surface stand for less than a whole h³, so the mean is a little more than 1 / (n + 1)³.
    expect((found.smallest * (n + 1) ** 3) / Math.PI ** 2).toBeGreaterThan(0.9);
    expect((found.smallest * (n + 1) ** 3) / Math.PI ** 2).toBeLessThan(1.25);
  });

  it('stays within the bounds of its elements: the worst of them, and that times those at a point', () => {
    const flat = sliver(1, 0.02);
    const both = mesh(
      [...[0, 1, 2, 3].map((i) => [...flat.points.slice(3 * i, 3 * i + 3)]), [0.5, 0.5, 1]],
      [
        [0, 1, 2, 3],
        [0, 1, 2, 4],
      ],
    );
    const worst = spectrumOf(flat)!.largest;
    expect(spectrumOf(both)!.largest).toBeGreaterThan(worst);
    expect(spectrumOf(both)!.largest).toBeLessThan(2 * worst + 1);
  });

  it('is not asked of a mesh that would hold the page up', () => {
    expect(spectrumOf({ points: new Float32Array(3), tets: new Uint32Array(4 * 60_001) })).toBeNull();
  });
});
