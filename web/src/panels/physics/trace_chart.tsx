import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { seek } from '../../store/run/player';
import { dark, largeType, time } from '../../store/view';
import { axisStyle } from '../controls/chart_style';
import { short } from '../controls/format';

export interface ChartLine {
  title: string;
  colour: string;
  values: number[];
}

const height = 130;

function optionsOf(lines: readonly ChartLine[], width: number, endMs: number | undefined): uPlot.Options {
  const ticks = (_: uPlot, all: number[]) => all.map((tick) => short(tick));
  return {
    width,
    height,
    padding: [6, 14, 0, 0],
    legend: { show: false },
    cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
    scales: { x: { time: false, ...(endMs !== undefined && { range: [0, endMs] }) } },
    axes: [
      { ...axisStyle(22), values: ticks },
      { ...axisStyle(38), values: ticks },
    ],
    series: [
      {},
      ...lines.map(({ title, colour }) => ({
        label: title,
        stroke: colour,
        width: 1.5,
        points: { show: false },
      })),
    ],
  };
}

/** A press and a drag move the time cursor. */
function seekByPointer(chart: uPlot): void {
  const follow = (event: PointerEvent) => {
    if (event.buttons === 1)
      seek(chart.posToVal(event.clientX - chart.over.getBoundingClientRect().left, 'x'));
  };
  chart.over.addEventListener('pointerdown', (event) => {
    chart.over.setPointerCapture(event.pointerId);
    follow(event);
  });
  chart.over.addEventListener('pointermove', follow);
}

/** Lines over time, with the time cursor where it is one of their times; `name` says what they are and their unit. */
export function TraceChart(props: {
  name: string;
  label: string;
  timesMs: number[];
  lines: readonly ChartLine[];
  /** The end of the axis, where more is to come. */
  endMs?: number;
  seeks: boolean;
}) {
  const { timesMs, lines, endMs, seeks } = props;
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const look = [
    ...lines.map(({ title, colour }) => title + colour),
    dark.value,
    largeType.value,
    endMs,
    seeks,
  ];
  useEffect(() => {
    const element = host.current;
    if (!element) return;
    const data = [timesMs, ...lines.map(({ values }) => values)] as uPlot.AlignedData;
    const chart = new uPlot(optionsOf(lines, element.clientWidth || 260, endMs), data, element);
    if (seeks) seekByPointer(chart);
    plot.current = chart;
    return () => {
      plot.current = null;
      chart.destroy();
    };
  }, [look.join()]);
  useEffect(() => plot.current?.setData([timesMs, ...lines.map(({ values }) => values)]), [timesMs]);
  const now = time.value;
  useEffect(() => {
    const chart = plot.current;
    if (chart && seeks) chart.setCursor({ left: chart.valToPos(now, 'x'), top: 0 }, false);
  });
  return (
    <figure class="electrograms">
      <figcaption>
        {props.name}
        {lines.map(({ title, colour }) => (
          <span key={title} class="electrogram-name">
            <i style={{ background: colour }} /> {title}
          </span>
        ))}
      </figcaption>
      <div ref={host} class="electrogram" role="img" aria-label={props.label} />
    </figure>
  );
}
