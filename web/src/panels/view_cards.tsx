import { colourStops } from '../geometry/colours';
import { focusTet, picked, type Legend } from '../store/view';
import { short } from './format';
import { Icon } from './icons';

export function LegendCard({ shown }: { shown: Legend | null }) {
  if (!shown) return null;
  const stops = colourStops(shown.map);
  const ticks = [1, 0.75, 0.5, 0.25, 0];
  return (
    <div
      class="legend"
      role="img"
      aria-label={`${shown.title} from ${short(shown.lo)} to ${short(shown.hi)} ${shown.unit}`}
    >
      <span class="legend-title">
        {shown.title}
        {shown.unit && <span class="unit"> {shown.unit}</span>}
      </span>
      <div class="legend-body">
        <svg width="14" height="120" aria-hidden="true">
          <defs>
            <linearGradient id="legend-scale" x1="0" y1="1" x2="0" y2="0">
              {stops.map((colour, i) => (
                <stop key={colour} offset={i / (stops.length - 1)} stop-color={colour} />
              ))}
            </linearGradient>
          </defs>
          <rect width="14" height="120" rx="2" fill="url(#legend-scale)" />
        </svg>
        <div class="legend-ticks">
          {ticks.map((t) => (
            <span key={t}>{short(Number((shown.lo + t * (shown.hi - shown.lo)).toPrecision(3)))}</span>
          ))}
        </div>
      </div>
    </div>
  );
}

export function PickedCard() {
  const found = picked.value;
  if (!found) return null;
  return (
    <div class="picked" role="status">
      <div class="picked-head">
        <strong>{found.title}</strong>
        <button
          type="button"
          class="icon-button small"
          aria-label="Close"
          onClick={() => {
            picked.value = null;
            focusTet.value = null;
          }}
        >
          <Icon name="cross" size={13} />
        </button>
      </div>
      <dl>
        {found.lines.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}
