import { paintColour } from '../../geometry/colours';
import { volume } from '../../store/case/input';
import {
  brushTool,
  erasePainted,
  paintedEdges,
  paintedVoxels,
  setPaintedEdge,
  type BrushTool,
} from '../../store/case/painting';
import { layout } from '../../store/view';
import { NumberField, NumberInput, Segments } from '../controls/fields';
import { short } from '../controls/format';
import { Icon } from '../controls/icons';

const set = (change: Partial<BrushTool>) => (brushTool.value = { ...brushTool.value, ...change });

/** Of the brush, in voxels. */
const [leastRadius, largestRadius] = [0.5, 20];
const voxelOf = () => Math.min(...(volume.value?.spacing_mm ?? [1]));

function turnOn(): void {
  const on = !brushTool.value.on;
  const voxel = voxelOf();
  const radius_mm = Math.min(Math.max(brushTool.value.radius_mm, leastRadius * voxel), largestRadius * voxel);
  set({ on, radius_mm });
  if (on) layout.value = 'slices';
}

function BrushFields() {
  const { erases, flat, radius_mm, edge_mm } = brushTool.value;
  const voxel = voxelOf();
  return (
    <div class="painter">
      <div class="painter-row">
        <Segments
          label="The brush"
          value={erases ? 'erase' : 'paint'}
          options={[
            ['paint', 'Paint'],
            ['erase', 'Erase'],
          ]}
          onChange={(way) => set({ erases: way === 'erase' })}
        />
        <Segments
          label="Shape of the brush"
          value={flat ? 'slice' : 'ball'}
          options={[
            ['ball', 'Ball', 'Through the slices'],
            ['slice', 'Slice', 'In the slice only'],
          ]}
          onChange={(shape) => set({ flat: shape === 'slice' })}
        />
      </div>
      {!erases && (
        <NumberField
          label="Edge length painted"
          unit="mm"
          path="sizing.masks.edges.edge_mm"
          step={0.1}
          value={edge_mm}
          onChange={(edge) => set({ edge_mm: edge })}
        />
      )}
      <label class="field">
        <span class="field-label">Radius</span>
        <span class="field-input">
          <input
            type="range"
            min={leastRadius * voxel}
            max={largestRadius * voxel}
            step={voxel / 2}
            value={radius_mm}
            aria-label="Radius of the brush"
            aria-valuetext={`${short(radius_mm)} mm`}
            onInput={(event) => set({ radius_mm: Number(event.currentTarget.value) })}
          />
          <span class="unit">{short(radius_mm)} mm</span>
        </span>
      </label>
      <p class="hint">Drag on a slice; Enter paints at the crosshair of the slice that has the focus.</p>
    </div>
  );
}

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
          <button
            type="button"
            class="icon-button small"
            aria-label={`Remove what is painted with ${edge_mm} mm`}
            title="Remove"
            onClick={() => erasePainted(label)}
          >
            <Icon name="trash" size={14} />
          </button>
        </div>
      ))}
    </div>
  );
}
