import { useRef } from 'preact/hooks';
import { axisMarks, beatsOf, nearestTime, placeAt, type Loop } from '../../store/run/beat/loops';
import { seek } from '../../store/run/player';
import { time } from '../../store/view';
import { short } from '../controls/format';

export interface LoopLine {
  name: string;
  colour: string;
  loop: Loop;
  periodMs: number;
  /** It is held against the others: of its beats the last is drawn, dashed. */
  kept: boolean;
}

const width = 268;
const height = 168;
const inset = { left: 40, right: 12, top: 8, bottom: 32 };

/** Ends of an axis and how values become places on it. */
function axisOf(values: number[], about: number, from: number, to: number) {
  const least = values.reduce((known, value) => Math.min(known, value), Infinity);
  const most = values.reduce((known, value) => Math.max(known, value), -Infinity);
  const marks = axisMarks(Math.min(least, most), most, about);
  const [lo, hi] = [marks[0], marks[marks.length - 1]];
  const perUnit = (to - from) / (hi - lo);
  return { marks, perUnit, at: (value: number) => from + (value - lo) * perUnit, lo };
}

/** Pressure over volume: earlier beats are faint, the place at the time cursor is a dot; a press or a drag moves it. */
export function LoopChart(props: { title: string; lines: readonly LoopLine[]; seeks: boolean }) {
  const { title, lines, seeks } = props;
  const svg = useRef<SVGSVGElement>(null);
  const shown = lines.map((line) => ({ ...line, beats: beatsOf(line.loop, line.periodMs) }));
  const drawn = shown.flatMap(({ loop, beats, kept }) => (kept ? beats.slice(-1) : [loop]));
  const x = axisOf(
    drawn.flatMap(({ ml }) => ml),
    5,
    inset.left,
    width - inset.right,
  );
  const y = axisOf([0, ...drawn.flatMap(({ kpa }) => kpa)], 4, height - inset.bottom, inset.top);
  const pathOf = ({ ml, kpa }: Loop) =>
    ml.map((volume, i) => `${i ? 'L' : 'M'}${x.at(volume).toFixed(1)} ${y.at(kpa[i]).toFixed(1)}`).join('');
  const own = shown.find(({ kept }) => !kept);
  const now = own && seeks ? placeAt(own.loop, time.value) : null;
  const follow = (event: PointerEvent) => {
    const box = svg.current?.getBoundingClientRect();
    if (!seeks || !own || !box || event.buttons !== 1) return;
    const at = {
      ml: x.lo + (((event.clientX - box.left) * width) / box.width - inset.left) / x.perUnit,
      kpa: y.lo + (((event.clientY - box.top) * height) / box.height - height + inset.bottom) / y.perUnit,
    };
    seek(nearestTime(own.loop, at, { ml: x.perUnit, kpa: y.perUnit }));
  };
  return (
    <svg
      ref={svg}
      class={seeks ? 'loop-chart seeks' : 'loop-chart'}
      viewBox={`0 0 ${width} ${height}`}
      role="img"
      aria-label={`${title}: pressure in kPa over volume in ml, ${own?.beats.length ?? 0} beats${
        lines.some(({ kept }) => kept) ? `, beside ${lines.filter(({ kept }) => kept).length} kept` : ''
      }`}
      onPointerDown={(event) => {
        svg.current?.setPointerCapture(event.pointerId);
        follow(event);
      }}
      onPointerMove={follow}
    >
      {x.marks.map((mark) => (
        <g key={mark}>
          <line class="grid" x1={x.at(mark)} x2={x.at(mark)} y1={inset.top} y2={height - inset.bottom} />
          <text x={x.at(mark)} y={height - inset.bottom + 12} text-anchor="middle">
            {short(mark)}
          </text>
        </g>
      ))}
      {y.marks.map((mark) => (
        <g key={mark}>
          <line class="grid" x1={inset.left} x2={width - inset.right} y1={y.at(mark)} y2={y.at(mark)} />
          <text x={inset.left - 5} y={y.at(mark) + 3.5} text-anchor="end">
            {short(mark)}
          </text>
        </g>
      ))}
      <text x={(inset.left + width - inset.right) / 2} y={height - 5} text-anchor="middle">
        Volume, ml
      </text>
      <text
        transform={`translate(10 ${(inset.top + height - inset.bottom) / 2}) rotate(-90)`}
        text-anchor="middle"
      >
        Pressure, kPa
      </text>
      {shown.map(({ name, colour, beats, kept }) =>
        beats.map((beat, i) =>
          kept && i < beats.length - 1 ? null : (
            <path
              key={`${name} ${i}`}
              d={pathOf(beat)}
              stroke={colour}
              class={kept ? 'kept' : i < beats.length - 1 ? 'earlier' : ''}
            />
          ),
        ),
      )}
      {now && own && <circle cx={x.at(now.ml)} cy={y.at(now.kpa)} r={4} fill={own.colour} />}
    </svg>
  );
}
