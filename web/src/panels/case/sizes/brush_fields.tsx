import { brushRadiiMm, brushTool, type BrushTool } from '../../../store/case/painting';
import { NumberField, Segments } from '../../controls/fields';
import { short } from '../../controls/format';

const set = (change: Partial<BrushTool>) => (brushTool.value = { ...brushTool.value, ...change });

export function BrushFields() {
  const { erases, flat, radius_mm, edge_mm } = brushTool.value;
  const [least, largest] = brushRadiiMm();
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
            min={least}
            max={largest}
            step={least}
            value={radius_mm}
            aria-label="Radius of the brush"
            aria-valuetext={`${short(radius_mm)} mm`}
            onInput={(event) => set({ radius_mm: Number(event.currentTarget.value) })}
          />
          <span class="unit">{short(radius_mm)} mm</span>
        </span>
      </label>
      <p class="hint">
        Drag on a slice, in labels that are meshed; Enter paints at the crosshair of the slice that has the
        focus.
      </p>
    </div>
  );
}
