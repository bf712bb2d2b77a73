import { colourStops, colourTable, hexOf } from '../../geometry/colours';
import { bandSteps, focusTet, layout, picked, type Legend } from '../../store/view';
import { short } from '../controls/format';
import { Icon } from '../controls/icons';

/** A scale on its side, for narrow panes. */
export function ScaleStrip({ shown }: { shown: Legend }) {
  const stops = colourStops(shown.map);
  const ends = [shown.lo, shown.hi].map((end) => short(Number(end.toPrecision(2))));
  return (
    <div class="scale-strip" role="img" aria-label={`${shown.title} from ${ends.join(' to ')} ${shown.unit}`}>
      <span>{ends[0]}</span>
      <svg width="90" height="9" aria-hidden="true">
        <linearGradient id={`strip-${shown.map}`}>
          {stops.map((colour, i) => (
            <stop key={colour} offset={i / (stops.length - 1)} stop-color={colour} />
          ))}
        </linearGradient>
        <rect width="90" height="9" rx="2" fill={`url(#strip-${shown.map})`} />
      </svg>
      <span>
        {ends[1]}
        {shown.unit === '°' ? '°' : shown.unit && ` ${shown.unit}`}
      </span>
    </div>
  );
}

/** The height of the scale, px. */
const scaleHeight = 120;

/** Bands from bottom to top: where each begins and ends, in px from the top, and its colour. */
function bandsOf({ lo, hi, map, bands = 1 }: Legend): { y: number; height: number; colour: string }[] {
  const table = colourTable(map);
  const place = (value: number) => Math.max(0, Math.min(1, (value - lo) / (hi - lo)));
  const first = Math.floor(lo / bands);
  const count = Math.max(1, Math.ceil(hi / bands) - first);
  return Array.from({ length: count }, (_, i) => {
    const [from, to] = [place((first + i) * bands), place((first + i + 1) * bands)];
    const at = 3 * Math.round(255 * place((first + i + 0.5) * bands));
    const colour = hexOf([table[at], table[at + 1], table[at + 2]]);
    return { y: scaleHeight * (1 - to), height: scaleHeight * (to - from), colour };
  });
}

export function LegendCard({ shown }: { shown: Legend | null }) {
  if (!shown) return null;
  if (layout.value !== 'model') {
    return (
      <div class="legend flat">
        <span class="legend-title">{shown.title}</span>
        <ScaleStrip shown={shown} />
      </div>
    );
  }
  const stops = colourStops(shown.map);
  const count = shown.bands ? Math.round((shown.hi - shown.lo) / shown.bands) : 0;
  const bandParts = count > 0 ? bandSteps(count) : undefined;
  const steps = shown.whole ? Math.min(8, shown.hi - shown.lo) : (bandParts ?? 4);
  const ticks = Array.from({ length: steps + 1 }, (_, i) => 1 - i / steps);
  return (
    <div
      class="legend"
      role="img"
      aria-label={`${shown.title} from ${short(shown.lo)} to ${short(shown.hi)} ${shown.unit}`}
    >
      <span class="legend-title">
        {shown.title}
        {shown.unit && <span class="unit"> {shown.unit}</span>}
        {shown.bands && <span class="unit">, lines every {short(shown.bands)}</span>}
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
          {shown.bands ? (
            bandsOf(shown).map(({ y, height, colour }) => (
              <rect
                key={y}
                y={y}
                width="14"
                height={height}
                fill={colour}
                stroke="#0008"
                stroke-width="0.5"
              />
            ))
          ) : (
            <rect width="14" height={scaleHeight} rx="2" fill="url(#legend-scale)" />
          )}
        </svg>
        <div class={shown.words ? 'legend-ticks words' : 'legend-ticks'}>
          {shown.words?.map((word) => <span key={word}>{word}</span>) ??
            ticks.map((t) => (
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
