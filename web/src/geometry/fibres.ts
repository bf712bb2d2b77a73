/** Fibres of a tetrahedral mesh as pieces to be drawn: short ones evenly spread, or lines that follow them. */
import type { TetArrays } from '../engine/contract';

type Mesh = Pick<TetArrays, 'points' | 'tets' | 'neighbours' | 'centres'>;

/** Straight pieces, one after the other: six numbers for the two ends, and the tetrahedron that each lies in. */
export interface Pieces {
  ends: Float32Array;
  tets: Uint32Array;
}

export interface FibreField {
  mesh: Mesh;
  /** Three numbers a tetrahedron: a unit vector whose sign means nothing, or 0 where there is no muscle. */
  fibre: Float32Array;
  /** Tetrahedra that are shown. */
  shows(tet: number): boolean;
}

const hasFibre = (fibre: Float32Array, tet: number) =>
  fibre[3 * tet] !== 0 || fibre[3 * tet + 1] !== 0 || fibre[3 * tet + 2] !== 0;

/** Cubes of one size over a mesh, numbered. */
class Cells {
  private readonly low: number[];
  private readonly counts: number[];
  readonly size: number;

  constructor(points: Float32Array, size: number) {
    const high = [-Infinity, -Infinity, -Infinity];
    this.low = [Infinity, Infinity, Infinity];
    points.forEach((x, i) => {
      this.low[i % 3] = Math.min(this.low[i % 3], x);
      high[i % 3] = Math.max(high[i % 3], x);
    });
    this.size = size;
    this.counts = high.map((x, d) => Math.max(1, Math.ceil((x - this.low[d]) / size) + 1));
  }

  at(x: number, y: number, z: number): number {
    const [i, j, k] = [x, y, z].map((one, d) => Math.floor((one - this.low[d]) / this.size));
    return i + this.counts[0] * (j + this.counts[1] * k);
  }

  /** From the middle of its cell, squared. */
  away(x: number, y: number, z: number): number {
    return [x, y, z].reduce((sum, one, d) => {
      const place = (one - this.low[d]) / this.size;
      return sum + (place - Math.floor(place) - 0.5) ** 2;
    }, 0);
  }
}

function volumeOf({ points, tets }: Mesh, tet: number): number {
  const [a, b, c, d] = [0, 1, 2, 3].map((k) => 3 * tets[4 * tet + k]);
  const edge = (from: number, to: number) => [0, 1, 2].map((x) => points[to + x] - points[from + x]);
  const [u, v, w] = [edge(a, b), edge(a, c), edge(a, d)];
  const [x, y, z] = [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]];
  return Math.abs(u[0] * x + u[1] * y + u[2] * z) / 6;
}

/** The edge of cubes of which the tetrahedra with fibres fill about so many, mm. */
export function cellSize({ mesh, fibre, shows }: FibreField, count: number): number {
  let volume = 0;
  for (let t = 0; t < fibre.length / 3; t++) if (shows(t) && hasFibre(fibre, t)) volume += volumeOf(mesh, t);
  return Math.cbrt(volume / count);
}

/** In each cube of this size the tetrahedron that is nearest to its middle, of those with a fibre. */
export function evenlySpread({ mesh, fibre, shows }: FibreField, size: number): Uint32Array {
  const { centres, points } = mesh;
  const cells = new Cells(points, size);
  const nearest = new Map<number, { tet: number; away: number }>();
  for (let tet = 0; tet < fibre.length / 3; tet++) {
    if (!shows(tet) || !hasFibre(fibre, tet)) continue;
    const [x, y, z] = [centres[4 * tet], centres[4 * tet + 1], centres[4 * tet + 2]];
    const cell = cells.at(x, y, z);
    const away = cells.away(x, y, z);
    const known = nearest.get(cell);
    if (!known || away < known.away) nearest.set(cell, { tet, away });
  }
  return Uint32Array.from(nearest.values(), ({ tet }) => tet);
}

/** A piece of this length, mm, in the middle of each of these tetrahedra. */
export function glyphPieces({ mesh, fibre }: FibreField, tets: Uint32Array, length: number): Pieces {
  const ends = new Float32Array(6 * tets.length);
  tets.forEach((tet, i) => {
    for (let d = 0; d < 3; d++) {
      const half = (length / 2) * fibre[3 * tet + d];
      ends[6 * i + d] = mesh.centres[4 * tet + d] - half;
      ends[6 * i + 3 + d] = mesh.centres[4 * tet + d] + half;
    }
  });
  return { ends, tets };
}

type Point = [number, number, number];

/** How often the way from one place to the next may cross a face, before it is given up. */
const mostCrossings = 40;

/** The tetrahedron at a place, on the way from one nearby; below 0 where the way leaves the mesh. */
export function walkTo({ points, tets, neighbours }: Mesh, from: number, [x, y, z]: Point): number {
  let tet = from;
  for (let crossing = 0; crossing < mostCrossings; crossing++) {
    const corners = [0, 1, 2, 3].map((k) => {
      const p = 3 * tets[4 * tet + k];
      return [points[p] - x, points[p + 1] - y, points[p + 2] - z];
    });
    const part = (a: number, b: number, c: number) => {
      const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = [corners[a], corners[b], corners[c]];
      return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    };
    // Volumes with the place in place of a corner, all of the sign of the whole where it is inside.
    const parts = [part(1, 3, 2), part(0, 2, 3), part(0, 3, 1), part(0, 1, 2)];
    const whole = parts[0] + parts[1] + parts[2] + parts[3];
    const shares = parts.map((one) => one / whole);
    const least = Math.min(...shares);
    if (least >= -1e-9) return tet;
    const next = neighbours[4 * tet + shares.indexOf(least)];
    if (next < 0) return -1;
    tet = next;
  }
  return -1;
}

/** The fibre of a tetrahedron and its neighbours, turned towards a direction; null where it has none. */
function alongFibre({ mesh, fibre, shows }: FibreField, tet: number, way: Point): Point | null {
  if (!shows(tet) || !hasFibre(fibre, tet)) return null;
  const sum: Point = [0, 0, 0];
  const add = (one: number) => {
    const at = 3 * one;
    const turned = fibre[at] * way[0] + fibre[at + 1] * way[1] + fibre[at + 2] * way[2] < 0 ? -1 : 1;
    for (let d = 0; d < 3; d++) sum[d] += turned * fibre[at + d];
  };
  add(tet);
  for (let k = 0; k < 4; k++) if (mesh.neighbours[4 * tet + k] >= 0) add(mesh.neighbours[4 * tet + k]);
  const size = Math.hypot(...sum);
  return size > 0 ? (sum.map((x) => x / size) as Point) : null;
}

const onwards = (at: Point, way: Point, by: number): Point => [
  at[0] + by * way[0],
  at[1] + by * way[1],
  at[2] + by * way[2],
];

export interface LineParams {
  /** Edge of the cubes, mm, in each of which a line begins that has none yet; a third of it is a line's step. */
  spacing: number;
  /** A line ends after this, mm, to either side; one that is shorter than a cube is left out. */
  longest: number;
}

/**
 * Lines along the fibres, evenly spread: each begins in a cube without any, goes both ways by the midpoint rule, and ends
 * at the boundary, where there is no fibre, after `longest`, or where it comes into a cube of half that size with another
 * line. Near to Jobard and Lefer, "Creating evenly-spaced streamlines of arbitrary density" (1997), with cubes for
 * their distances.
 * Yields after each line, so that whoever draws can let the page answer.
 */
export function* tracedLines(
  field: FibreField,
  { spacing, longest }: LineParams,
): Generator<void, Pieces, void> {
  const { mesh, fibre } = field;
  const cells = new Cells(mesh.points, spacing);
  const small = new Cells(mesh.points, spacing / 2);
  const begun = new Set<number>();
  const taken = new Map<number, number>();
  const step = spacing / 3;
  const ends: number[] = [];
  const tets: number[] = [];
  let line = 0;
  /** Places from the seed on, without it, and their tetrahedra. */
  const oneWay = (seed: number, start: Point, first: Point) => {
    const places: { at: Point; tet: number }[] = [];
    let [at, tet, way] = [start, seed, first];
    for (let done = 0; done < longest; done += step) {
      const middle = walkTo(mesh, tet, onwards(at, way, step / 2));
      const there = middle >= 0 ? alongFibre(field, middle, way) : null;
      if (!there) break;
      const next = onwards(at, there, step);
      const into = walkTo(mesh, middle, next);
      const goesOn = into >= 0 ? alongFibre(field, into, there) : null;
      if (!goesOn) break;
      const cell = small.at(...next);
      if ((taken.get(cell) ?? line) !== line) break;
      taken.set(cell, line);
      begun.add(cells.at(...next));
      places.push({ at: next, tet: into });
      [at, tet, way] = [next, into, goesOn];
    }
    return places;
  };
  for (const seed of evenlySpread(field, spacing)) {
    const start = [...mesh.centres.subarray(4 * seed, 4 * seed + 3)] as Point;
    if (begun.has(cells.at(...start))) continue;
    begun.add(cells.at(...start));
    taken.set(small.at(...start), ++line);
    const forth = [...fibre.subarray(3 * seed, 3 * seed + 3)] as Point;
    const back = forth.map((x) => -x) as Point;
    const places = [
      ...oneWay(seed, start, back).reverse(),
      { at: start, tet: seed },
      ...oneWay(seed, start, forth),
    ];
    if (step * (places.length - 1) >= spacing)
      for (let i = 1; i < places.length; i++) {
        ends.push(...places[i - 1].at, ...places[i].at);
        tets.push(places[i].tet);
      }
    yield;
  }
  return { ends: Float32Array.from(ends), tets: Uint32Array.from(tets) };
}
