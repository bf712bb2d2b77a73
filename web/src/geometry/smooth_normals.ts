/**
 * Normals for smooth shading, three numbers a corner: averaged by area between triangles that meet at a point and
 * divide the same pair of labels, so that edges between labels stay sharp.
 */
export function smoothNormals(surface: {
  points: Float32Array;
  triangles: Uint32Array;
  sides: Uint16Array;
}): Float32Array {
  const { points, triangles, sides } = surface;
  const normals = new Float32Array(3 * triangles.length);
  const groups = new Map<number, number[]>();
  for (let t = 0; t < triangles.length / 3; t++) {
    const pair = sides[2 * t] * 65536 + sides[2 * t + 1];
    const group = groups.get(pair);
    if (group) group.push(t);
    else groups.set(pair, [t]);
  }
  const sums = new Float32Array(points.length);
  for (const group of groups.values()) {
    for (const t of group) addNormal(points, triangles, t, sums);
    for (const t of group) {
      for (let c = 0; c < 3; c++) {
        const p = 3 * triangles[3 * t + c];
        const length = Math.sqrt(sums[p] ** 2 + sums[p + 1] ** 2 + sums[p + 2] ** 2) || 1;
        for (let d = 0; d < 3; d++) normals[9 * t + 3 * c + d] = sums[p + d] / length;
      }
    }
    for (const t of group) {
      for (let c = 0; c < 3; c++) {
        const p = 3 * triangles[3 * t + c];
        sums[p] = sums[p + 1] = sums[p + 2] = 0;
      }
    }
  }
  return normals;
}

/** Adds a triangle's normal, as long as twice its area, to each of its corners. */
function addNormal(points: Float32Array, triangles: Uint32Array, t: number, sums: Float32Array): void {
  const a = 3 * triangles[3 * t];
  const b = 3 * triangles[3 * t + 1];
  const c = 3 * triangles[3 * t + 2];
  const ux = points[b] - points[a];
  const uy = points[b + 1] - points[a + 1];
  const uz = points[b + 2] - points[a + 2];
  const vx = points[c] - points[a];
  const vy = points[c + 1] - points[a + 1];
  const vz = points[c + 2] - points[a + 2];
  for (const p of [a, b, c]) {
    sums[p] += uy * vz - uz * vy;
    sums[p + 1] += uz * vx - ux * vz;
    sums[p + 2] += ux * vy - uy * vx;
  }
}
