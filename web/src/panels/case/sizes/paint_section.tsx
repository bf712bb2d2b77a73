import { paintColour } from '../../../geometry/colours';
import {
  brushRadiiMm,
  brushTool,
  erasePainted,
  paintedEdges,
  paintedVoxels,
  setPaintedEdge,
} from '../../../store/case/painting';
import { chooseLayout } from '../../../store/view';
import { fetched } from '../../controls/fetched';
import { NumberInput } from '../../controls/fields';
import { RemoveButton } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';

/** Switches the brush on or off, its radius within what it may have. */
function turnOn(): void {
  const on = !brushTool.value.on;
  const [least, largest] = brushRadiiMm();
  const radius_mm = Math.min(Math.max(brushTool.value.radius_mm, least), largest);
  brushTool.value = { ...brushTool.value, on, radius_mm };
  if (on) chooseLayout('slices');
}

/** Fields of the brush while it is on. */
const BrushFields = fetched(() => import('./brush_fields').then((part) => part.BrushFields));

/** A mask of sizes painted on the slices. */
export function PaintSection() {
  const { on } = brushTool.value;
  const edges = paintedVoxels() ? paintedEdges() : [];
  return (
    <div class="regions">
      <div class="regions-head">
        <h3>Painted sizes</h3>
        <button type="button" class="button small" aria-pressed={on} onClick={turnOn}>
          <Icon name="brush" size={13} /> {on ? 'Stop painting' : 'Paint…'}
        </button>
      </div>
      {!on && edges.length === 0 && <p class="hint">Edge lengths painted on the slices with a brush.</p>}
      {on && <BrushFields />}
      {edges.map(({ label, edge_mm }) => (
        <div key={label} class="painted">
          <svg class="dot" viewBox="0 0 8 8" aria-hidden="true">
            <circle cx="4" cy="4" r="4" fill={paintColour(label)} />
          </svg>
          <NumberInput
            label={`Painted edge length ${label}`}
            path="sizing.masks.edges.edge_mm"
            step={0.1}
            value={edge_mm}
            onChange={(edge) => edge !== null && setPaintedEdge(label, edge)}
          />
          <span class="unit">mm</span>
          <RemoveButton what={`what is painted with ${edge_mm} mm`} onRemove={() => erasePainted(label)} />
        </div>
      ))}
    </div>
  );
}
