import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { axisMarks } from '../../store/run/beat/loops';
import type { Study, StudyRow } from '../../store/study/read_study';
import { short, whole } from '../controls/format';
import { columnTitle, columnWords, withUnit } from './column_words';

interface Point {
  row: StudyRow;
  x: number;
  y: number;
  outlying: boolean;
}

const inset = { left: 52, right: 24, top: 10, bottom: 40 };
/** So near a point has to be to be meant, px. */
const reach = 24;

/** Marks of an axis, and how values become places on it. */
function axisOf(values: readonly number[], about: number, from: number, to: number) {
  const least = values.reduce((known, value) => Math.min(known, value), Infinity);
  const most = values.reduce((known, value) => Math.max(known, value), -Infinity);
  const room = most > least ? 0 : Math.max(Math.abs(most) / 20, 0.5);
  const marks = axisMarks(least - room, most + room, about);
  const [lo, hi] = [marks[0], marks[marks.length - 1]];
  return { marks, at: (value: number) => from + ((value - lo) * (to - from)) / (hi - lo) };
}

/** Dots as one path: a line of no length has round ends. */
const dots = (points: readonly Point[]) =>
  points.map(({ x, y }) => `M${x.toFixed(1)} ${y.toFixed(1)}h.01`).join('');

/** As wide as there is room, and less tall. */
function useSize() {
  const element = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(360);
  useEffect(() => {
    if (!element.current) return;
    const observer = new ResizeObserver(
      ([{ contentRect }]) => contentRect.width > 0 && setWidth(contentRect.width),
    );
    observer.observe(element.current);
    return () => observer.disconnect();
  }, []);
  return { host: element, width, height: Math.round(Math.max(240, Math.min(440, 0.7 * width))) };
}

/** Each case that has both values is a dot; outliers of either are marked. A press selects the nearest. */
export function ScatterChart(props: {
  of: Study;
  x: string;
  y: string;
  selected: StudyRow | null;
  onSelect(row: StudyRow): void;
  onOpen(row: StudyRow): void;
}) {
  const { of, x, y, selected, onSelect, onOpen } = props;
  const { host, width, height } = useSize();
  const [near, setNear] = useState<Point | null>(null);
  const chart = useMemo(() => {
    const rows = of.rows.filter(
      ({ values }) => typeof values[x] === 'number' && typeof values[y] === 'number',
    );
    if (rows.length === 0) return null;
    const valuesOf = (name: string) => rows.map(({ values }) => values[name] as number);
    const across = axisOf(valuesOf(x), Math.max(2, Math.round(width / 80)), inset.left, width - inset.right);
    const upwards = axisOf(valuesOf(y), 5, height - inset.bottom, inset.top);
    const points = rows.map(
      (row): Point => ({
        row,
        x: across.at(row.values[x] as number),
        y: upwards.at(row.values[y] as number),
        outlying: row.outlying.includes(x) || row.outlying.includes(y),
      }),
    );
    const usual = dots(points.filter(({ outlying }) => !outlying));
    return { across, upwards, points, usual };
  }, [of, x, y, width, height]);
  if (!chart) return <p class="brush-hint">No case has values of both.</p>;
  const { across, upwards, points, usual } = chart;
  const outliers = points.filter(({ outlying }) => outlying);
  const chosen = points.find(({ row }) => row === selected);
  const nearest = (event: MouseEvent & { currentTarget: SVGSVGElement }): Point | null => {
    const box = event.currentTarget.getBoundingClientRect();
    const scale = width / box.width;
    const at = { x: (event.clientX - box.left) * scale, y: (event.clientY - box.top) * scale };
    const far = (point: Point) => Math.hypot(point.x - at.x, point.y - at.y);
    const found = points.reduce((known, point) => (far(point) < far(known) ? point : known));
    return far(found) <= reach ? found : null;
  };
  return (
    <figure class="scatter">
      <div class="scatter-host" ref={host}>
        <svg
          viewBox={`0 0 ${width} ${height}`}
          role="img"
          aria-label={`${columnWords(y)} over ${columnWords(x).toLowerCase()} of ${whole(points.length)} cases, ${whole(
            outliers.length,
          )} of them outliers`}
          class={near ? 'near' : ''}
          onPointerMove={(event) => setNear(nearest(event))}
          onPointerLeave={() => setNear(null)}
          onPointerUp={(event) => {
            const point = nearest(event);
            if (point) onSelect(point.row);
          }}
          onDblClick={(event) => {
            const point = nearest(event);
            if (point) onOpen(point.row);
          }}
        >
          {across.marks.map((mark) => (
            <g key={mark}>
              <line
                class="grid"
                x1={across.at(mark)}
                x2={across.at(mark)}
                y1={inset.top}
                y2={height - inset.bottom}
              />
              <text x={across.at(mark)} y={height - inset.bottom + 15} text-anchor="middle">
                {short(mark)}
              </text>
            </g>
          ))}
          {upwards.marks.map((mark) => (
            <g key={mark}>
              <line
                class="grid"
                x1={inset.left}
                x2={width - inset.right}
                y1={upwards.at(mark)}
                y2={upwards.at(mark)}
              />
              <text x={inset.left - 7} y={upwards.at(mark) + 4} text-anchor="end">
                {short(mark)}
              </text>
            </g>
          ))}
          <text
            class="axis-title"
            x={(inset.left + width - inset.right) / 2}
            y={height - 6}
            text-anchor="middle"
          >
            {columnTitle(x)}
          </text>
          <text
            class="axis-title"
            transform={`translate(11 ${(inset.top + height - inset.bottom) / 2}) rotate(-90)`}
            text-anchor="middle"
          >
            {columnTitle(y)}
          </text>
          <path class="dots" d={usual} />
          {outliers.map((point) => (
            <path
              key={point.row.case}
              class="outlier"
              d={`M${point.x} ${point.y - 5.5}l5.5 5.5l-5.5 5.5l-5.5 -5.5z`}
            />
          ))}
          {near && near.row !== selected && <circle class="ring" cx={near.x} cy={near.y} r="7" />}
          {chosen && <circle class="ring chosen" cx={chosen.x} cy={chosen.y} r="7.5" />}
        </svg>
        {near && (
          <div
            class={near.x > width / 2 ? 'scatter-tip left' : 'scatter-tip'}
            style={{ left: `${near.x}px`, top: `${near.y}px` }}
            aria-hidden="true"
          >
            <strong>{near.row.name}</strong>
            <span>{`${columnWords(x)} ${withUnit(near.row.values[x], x)}`}</span>
            <span>{`${columnWords(y)} ${withUnit(near.row.values[y], y)}`}</span>
          </div>
        )}
      </div>
      <figcaption>
        <span class="scatter-key case">case</span>
        {outliers.length > 0 && <span class="scatter-key outlier">outlier of either column</span>}
        {chosen && <span class="scatter-key chosen">{chosen.row.name}</span>}
      </figcaption>
    </figure>
  );
}
