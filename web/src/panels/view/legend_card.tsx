import { colourStops } from '../../geometry/colours';
import { boxesOf, clipped, ticksOf } from '../../geometry/scale';
import type { Legend } from '../../store/view';
import { short } from '../controls/format';

/** Of the drawing, in its own units; the scale lies between the marks of values beyond it. */
const width = 300;
const [left, right] = [16, width - 16];
const chart = 22;
const bar = 11;
const xOf = (part: number) => left + part * (right - left);

/** How the values spread over the scale; few bad ones are seen beside many good ones. */
function Spread({ counts }: { counts: readonly number[] }) {
  const most = Math.max(1, ...counts);
  const steps = counts.map((count, i) => {
    const y = count > 0 ? chart - 1.5 - (chart - 3.5) * (count / most) : chart;
    return `L${xOf(i / counts.length).toFixed(1)} ${y.toFixed(1)}H${xOf((i + 1) / counts.length).toFixed(1)}`;
  });
  return <path class="legend-spread" d={`M${left} ${chart}${steps.join('')}V${chart}Z`} />;
}

function Bar({ shown }: { shown: Legend }) {
  const stops = colourStops(shown.map);
  const boxes = boxesOf(shown);
  if (boxes.length > 0)
    return (
      <>
        {boxes.map(({ from, to, colour }) => (
          <rect
            key={from}
            class="legend-box"
            x={xOf(from)}
            y={chart}
            width={xOf(to) - xOf(from)}
            height={bar}
            fill={colour}
          />
        ))}
      </>
    );
  return (
    <>
      <linearGradient id="legend-scale">
        {stops.map((colour, i) => (
          <stop key={i} offset={i / (stops.length - 1)} stop-color={colour} />
        ))}
      </linearGradient>
      <rect x={left} y={chart} width={right - left} height={bar} fill="url(#legend-scale)" />
    </>
  );
}

/** What the colours of the body mean, below it. */
export function LegendCard({ shown }: { shown: Legend }) {
  const { below, above } = clipped(shown);
  const { title, unit, lo, hi, values, bands, counts, words } = shown;
  const range = values && !words && `${short(values[0])} to ${short(values[1])}`;
  const beyond = below || above ? `, values from ${range}` : '';
  return (
    <div class="legend" role="img" aria-label={`${title} from ${short(lo)} to ${short(hi)} ${unit}${beyond}`}>
      <div class="legend-head">
        <span class="legend-title">
          {title}
          {unit && <span class="unit"> {unit}</span>}
          {bands && <span class="unit">, lines every {short(bands)}</span>}
        </span>
        {range && <span class="legend-range">{range}</span>}
      </div>
      <svg viewBox={`0 ${counts ? 0 : chart - 2} ${width} ${counts ? 50 : 30}`} aria-hidden="true">
        {counts && <Spread counts={counts} />}
        <Bar shown={shown} />
        {below && (
          <text class="legend-clip" x={left - 4} y={chart + 10} text-anchor="end">
            {'<'}
          </text>
        )}
        {above && (
          <text class="legend-clip" x={right + 4} y={chart + 10}>
            {'>'}
          </text>
        )}
        {ticksOf(shown).map(({ at, text }) => (
          <g key={text}>
            <path class="legend-tick" d={`M${xOf(at)} ${chart + bar}v3`} />
            <text x={xOf(at)} y={chart + bar + 14} text-anchor="middle">
              {text}
            </text>
          </g>
        ))}
      </svg>
    </div>
  );
}
