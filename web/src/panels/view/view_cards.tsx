import { colourStops } from '../../geometry/colours';
import { colourOf, nameOf } from '../../store/case/legend/legend';
import { bodyLegend, labelsShown, layout, picked, sliceLegend, type Legend } from '../../store/view';
import { fetched } from '../controls/fetched';
import { short } from '../controls/format';

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
            <stop key={i} offset={i / (stops.length - 1)} stop-color={colour} />
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

/** The most labels that a key names. */
const mostNames = 8;

function LabelKey({ labels }: { labels: readonly number[] }) {
  const named = labels.length > mostNames ? labels.slice(0, mostNames - 1) : labels;
  return (
    <ul class="label-key" aria-label="Labels">
      {named.map((label) => (
        <li key={label}>
          <svg class="dot" viewBox="0 0 8 8" aria-hidden="true">
            <rect width="8" height="8" rx="1.5" fill={colourOf.value(label)} />
          </svg>
          <span>{nameOf(label)}</span>
        </li>
      ))}
      {named.length < labels.length && <li class="muted">and {labels.length - named.length} more</li>}
    </ul>
  );
}

const LegendCard = fetched(() => import('./legend_card').then((part) => part.LegendCard));
const PickedCard = fetched(() => import('./picked_card').then((part) => part.PickedCard));

/** What colours mean, and the element that was picked. */
export function ViewCards() {
  const alone = layout.value === 'model';
  const shown = bodyLegend.value ?? (alone ? sliceLegend.value : null);
  const labels = labelsShown.value;
  const found = picked.value;
  return (
    <>
      {shown && alone && <LegendCard shown={shown} />}
      {shown && !alone && (
        <div class="legend flat">
          <span class="legend-title">{shown.title}</span>
          <ScaleStrip shown={shown} />
        </div>
      )}
      {!shown && alone && labels.length > 0 && <LabelKey labels={labels} />}
      {found && <PickedCard found={found} />}
    </>
  );
}
