import { useEffect, useRef } from 'preact/hooks';
import type { SizeRegion } from '../../../engine/contract';
import { editRecipe } from '../../../store/case/recipe';
import { BodyFields, BodyHandles, BodyShape } from '../../controls/body_fields';
import { NumberField } from '../../controls/fields';

/** Scrolls a panel, and nothing else, until a card of it is in sight: its end, or its head where it is longer. */
function bringIntoSight(card: Element | null | undefined): void {
  const panel = card?.closest('.panel');
  if (!card || !panel) return;
  const [box, frame] = [card.getBoundingClientRect(), panel.getBoundingClientRect()];
  const toHead = box.top - frame.top - 8;
  panel.scrollTop += Math.min(toHead, Math.max(0, box.bottom - frame.bottom + 8));
}

export function RegionFields({ region, index }: { region: SizeRegion; index: number }) {
  const body = { kind: 'region', index } as const;
  const first = useRef<HTMLDivElement>(null);
  useEffect(() => bringIntoSight(first.current?.closest('.region')), []);
  const set = (label: string, change: Partial<SizeRegion>) =>
    editRecipe(
      label,
      (draft) => void Object.assign(draft.sizing.regions[index], change),
      `region ${index} ${label}`,
    );
  const number = (label: string, key: 'edge_mm' | 'band_mm', step: number) => (
    <NumberField
      label={label}
      owner={region.name}
      unit="mm"
      path={`sizing.regions.${key}`}
      step={step}
      value={region[key]}
      onChange={(value) => set(label, { [key]: value })}
    />
  );
  return (
    <>
      <BodyHandles shape={region.shape} />
      <div class="field" ref={first}>
        <span class="field-label">Name</span>
        <span class="field-input wide">
          <input
            type="text"
            aria-label="Region name"
            maxLength={60}
            value={region.name}
            onInput={(event) => set('Name of region', { name: event.currentTarget.value })}
          />
        </span>
      </div>
      <BodyShape body={body} region={region} />
      {number('Edge inside', 'edge_mm', 0.1)}
      {number('Transition', 'band_mm', 1)}
      <BodyFields body={body} region={region} path="sizing.regions" owner={region.name} />
    </>
  );
}
