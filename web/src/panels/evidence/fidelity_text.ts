import type { DistanceSummary, LabelTopology, Report } from '../../engine/contract';
import { short } from '../controls/format';

/** One number of a label's topology, before and after. */
export interface TopologyCell {
  text: string;
  changed: boolean;
}

export interface TopologyRow {
  label: number;
  components: TopologyCell;
  cavities: TopologyCell;
  handles: TopologyCell;
  pinched: TopologyCell;
}

function cell([before, after]: [number, number]): TopologyCell {
  return before === after
    ? { text: String(before), changed: false }
    : { text: `${before} → ${after}`, changed: true };
}

export function topologyRow(found: LabelTopology): TopologyRow {
  const pinches = found.pinched_edges + found.pinched_points;
  return {
    label: found.label,
    components: cell(found.components),
    cavities: cell(found.cavities),
    handles: cell(found.handles),
    pinched: { text: String(pinches), changed: pinches > 0 },
  };
}

/** With its sign, unless it rounds to nothing. */
export function percent(value: number): string {
  const digits = Math.abs(value).toFixed(2);
  const sign = Number(digits) === 0 ? '' : value < 0 ? '−' : '+';
  return `${sign}${digits} %`;
}

/** "mean 0.06 mm, 95 % below 0.18 mm, largest 0.85 to 0.9 mm": the largest with what its search left open. */
export function distanceText(found: DistanceSummary): string {
  const most = found.max_mm + found.uncertainty_mm;
  const largest =
    short(found.max_mm) === short(most) ? short(most) : `${short(found.max_mm)} to ${short(most)}`;
  return `mean ${short(found.mean_mm)} mm, 95 % below ${short(found.p95_mm)} mm, largest ${largest} mm`;
}

/** What the stages noted, each under its stage's name. */
export function notesOf(found: Report): string[] {
  return found.stages.flatMap((stage) => stage.notes.map((note) => `${stage.name}: ${note}`));
}
