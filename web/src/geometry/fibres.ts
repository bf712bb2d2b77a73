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
  private readonly low = new Float64Array(3).fill(Infinity);
  private readonly counts = [1, 1, 1];
  private readonly size: number;

  constructor(points: Float32Array, size: number) {
    const high = new Float64Array(3).fill(-Infinity);
    for (let i = 0, d = 0; i < points.length; i++, d = (d + 1) % 3) {
      this.low[d] = Math.min(this.low[d], points[i]);
      high[d] = Math.max(high[d], points[i]);
    }
    this.size = size;
    for (let d = 0; d < 3; d++) this.counts[d] = Math.floor((high[d] - this.low[d]) / size) + 1;
  }

  at(x: number, y: number, z: number): number {
    const i = Math.floor((x - this.low[0]) / this.size);
    const j = Math.floor((y - this.low[1]) / this.size);
    const k = Math.floor((z - this.low[2]) / this.size);
    return i + this.counts[0] * (j + this.counts[1] * k);
  }

  /** From the middle of its cube in each direction, squared and added up. */
  away(x: number, y: number, z: number): number {
    return this.off(x, 0) + this.off(y, 1) + this.off(z, 2);
  }

  private off(x: number, d: number): number {
    const place = (x - this.low[d]) / this.size;
    return (place - Math.floor(place) - 0.5) ** 2;
  }
}

function volumeOf({ points, tets }: Mesh, tet: number): number {
  const a = 3 * tets[4 * tet];
  const b = 3 * tets[4 * tet + 1];
  const c = 3 * tets[4 * tet + 2];
  const d = 3 * tets[4 * tet + 3];
  const [ax, ay, az] = [points[a], points[a + 1], points[a + 2]];
  const [ux, uy, uz] = [points[b] - ax, points[b + 1] - ay, points[b + 2] - az];
  const [vx, vy, vz] = [points[c] - ax, points[c + 1] - ay, points[c + 2] - az];
  const [wx, wy, wz] = [points[d] - ax, points[d + 1] - ay, points[d + 2] - az];
  return Math.abs(ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx)) / 6;
}

/** After so many tetrahedra whoever draws may let the page answer. */
const sliceTets = 8_000;

/** The edge of cubes of which the tetrahedra with fibres fill about so many, mm. Yields on its way. */
export function* cellSize({ mesh, fibre, shows }: FibreField, count: number): Generator<void, number, void> {
  let volume = 0;
  for (let t = 0; t < fibre.length / 3; t++) {
    if (shows(t) && hasFibre(fibre, t)) volume += volumeOf(mesh, t);
    if (t % sliceTets === 0) yield;
  }
  return Math.cbrt(volume / count);
}

/** In each cube of this size the tetrahedron nearest to its middle, of those with a fibre. Yields on its way. */
export function* evenlySpread(
  { mesh, fibre, shows }: FibreField,
  size: number,
): Generator<void, Uint32Array, void> {
  const { centres, points } = mesh;
  const cells = new Cells(points, size);
  const nearest = new Map<number, { tet: number; away: number }>();
  for (let tet = 0; tet < fibre.length / 3; tet++) {
    if (tet % sliceTets === 0) yield;
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

/** Six times the volume of a place and three points, with a sign. */
function sixfold(points: Float32Array, [x, y, z]: Point, a: number, b: number, c: number): number {
  const ax = points[3 * a] - x;
  const ay = points[3 * a + 1] - y;
  const az = points[3 * a + 2] - z;
  const bx = points[3 * b] - x;
  const by = points[3 * b + 1] - y;
  const bz = points[3 * b + 2] - z;
  const cx = points[3 * c] - x;
  const cy = points[3 * c + 1] - y;
  const cz = points[3 * c + 2] - z;
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}

/** The tetrahedron at a place, on the way from one nearby; below 0 where the way leaves the mesh. */
export function walkTo({ points, tets, neighbours }: Mesh, from: number, place: Point): number {
  let tet = from;
  for (let crossing = 0; crossing < mostCrossings; crossing++) {
    const a = tets[4 * tet];
    const b = tets[4 * tet + 1];
    const c = tets[4 * tet + 2];
    const d = tets[4 * tet + 3];
    // Volumes with the place instead of each corner: all of the whole's sign where it is inside.
    const parts = [
      sixfold(points, place, b, d, c),
      sixfold(points, place, a, c, d),
      sixfold(points, place, a, d, b),
      sixfold(points, place, a, b, c),
    ];
    const whole = parts[0] + parts[1] + parts[2] + parts[3];
    let least = 0;
    for (let k = 1; k < 4; k++) if (parts[k] / whole < parts[least] / whole) least = k;
    if (parts[least] / whole >= -1e-9) return tet;
    tet = neighbours[4 * tet + least];
    if (tet < 0) return -1;
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
 * Yields on its way, and after each line.
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
  for (const seed of yield* evenlySpread(field, spacing)) {
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
  return { ends: new Float32Array(ends), tets: new Uint32Array(tets) };
}
