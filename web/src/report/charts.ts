/** Which histograms of a report stand together in one chart. */
import type { Histogram, Metric, Report } from '../engine/contract';

import { spreadByFactor } from '../geometry/histogram';

export interface Series {
  name: string;
  histogram: Histogram;
  /** What it is to be read against: the mesh that is shown, what came before it, another run. */
  tone: 'now' | 'before' | 'pinned';
}

/** One of the fixed charts, or the name of a measure of tetrahedra. */
export type ChartKind = string;
export type Charts = Record<ChartKind, Series[]>;

/** Measures of tetrahedra, but for the angles, which have a chart of their own. */
export function shapeMeasures(found: Report): Metric[] {
  return found.quality.metrics.filter(
    ({ name, elements }) => elements === 'tets' && !name.includes('dihedral'),
  );
}

function histogramOf(found: Report, metric: string): Histogram | null {
  const entry = found.quality.metrics.find((candidate) => candidate.name === metric);
  return entry && entry.histogram.counts.some((count) => count > 0) ? entry.histogram : null;
}

/**
 * No mesh of well-shaped tetrahedra has edges of one length. Lengths between 1/√2 and √2 of the target are as good as
 * it (quasi-unit meshes; Frey and George, "Mesh generation", 2008), which is what a target is to be held against.
 */
export const evenFactor = Math.SQRT2;

function make(found: Report, pinned: Report | null): Charts {
  const one = (metric: string, name: string, tone: Series['tone'] = 'now', of = found): Series[] => {
    const histogram = histogramOf(of, metric);
    return histogram ? [{ name, histogram, tone }] : [];
  };
  const against = (metric: string, name: string): Series[] =>
    pinned ? [...one(metric, 'Pinned', 'pinned', pinned), ...one(metric, 'This run')] : one(metric, name);
  return {
    edges: pinned
      ? against('edge_mm', 'Edge length')
      : [
          ...one('target_edge_mm', 'Target × 0.71 to 1.41', 'before').map((series) => ({
            ...series,
            histogram: spreadByFactor(series.histogram, evenFactor),
          })),
          ...one('edge_mm', 'Edge length'),
        ],
    ratios: against('size_log2', 'Size ratio'),
    aspects: pinned
      ? against('triangle_aspect_after', 'Adapted surface')
      : [
          ...one('triangle_aspect_before', 'Label surface', 'before'),
          ...one('triangle_aspect_after', 'Adapted surface'),
        ],
    angles: against('dihedral_deg', 'All six angles of each element'),
    ...Object.fromEntries(
      shapeMeasures(found).map(({ name, title }) => [name, against(name, title || name)]),
    ),
  };
}

let last: { found: Report; pinned: Report | null; charts: Charts } | null = null;

/** Series keep their identity for the same reports, so that charts are not rebuilt with every render. */
export function seriesOf(found: Report, pinned: Report | null = null): Charts {
  if (last?.found !== found || last.pinned !== pinned) last = { found, pinned, charts: make(found, pinned) };
  return last.charts;
}
