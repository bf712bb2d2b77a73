/** Corners of the face opposite corner i, ordered so that the normal points out of a positive tetrahedron. */
export const oppositeFace = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
] as const;

/**
 * Face neighbours of a tetrahedral mesh: four entries a tet, entry i is the tet across the face opposite
 * corner i, or -1. Linear time: faces are bucketed by their smallest corner, then matched inside the bucket.
 */
export function tetNeighbours(tets: Uint32Array, pointCount: number): Int32Array {
  const faceCount = tets.length;
  const low = new Uint32Array(faceCount);
  const middle = new Uint32Array(faceCount);
  const high = new Uint32Array(faceCount);
  const start = new Uint32Array(pointCount + 1);
  for (let face = 0; face < faceCount; face++) {
    const tet = face & ~3;
    const corners = oppositeFace[face & 3];
    const a = tets[tet + corners[0]];
    const b = tets[tet + corners[1]];
    const c = tets[tet + corners[2]];
    const least = Math.min(a, b, c);
    const most = Math.max(a, b, c);
    low[face] = least;
    high[face] = most;
    middle[face] = a + b + c - least - most;
    start[least + 1]++;
  }
  for (let p = 0; p < pointCount; p++) start[p + 1] += start[p];
  const cursor = start.slice(0, pointCount);
  const order = new Uint32Array(faceCount);
  for (let face = 0; face < faceCount; face++) order[cursor[low[face]]++] = face;

  const neighbours = new Int32Array(faceCount).fill(-1);
  for (let p = 0; p < pointCount; p++) {
    for (let i = start[p]; i < start[p + 1]; i++) {
      const face = order[i];
      if (neighbours[face] >= 0) continue;
      for (let j = i + 1; j < start[p + 1]; j++) {
        const other = order[j];
        if (middle[face] === middle[other] && high[face] === high[other]) {
          neighbours[face] = other >> 2;
          neighbours[other] = face >> 2;
          break;
        }
      }
    }
  }
  return neighbours;
}
