import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { coveringRange, rebin } from '../../geometry/histogram';
import type { Series } from '../../report/charts';
import { dark, largeType } from '../../store/view';
import { axisStyle, cssColour } from './chart_style';
import { short } from './format';

interface HistogramProps {
  title: string;
  unit: string;
  /** What is counted, as in "share of edges". */
  of: string;
  series: Series[];
  range?: [number, number];
  /** How many bins there are across it. */
  bins?: number;
  /** What is good, shown behind the bars. */
  band?: [number, number];
  /** Values of the axis as text. */
  tick?(value: number): string;
  selected?: [number, number] | null;
  onSelect?(lo: number, hi: number): void;
}

const height = 118;
/** What is narrower is no selection, px. */
const least = 3;

function showSelection(chart: uPlot, selected: [number, number] | null | undefined): void {
  if (!selected) {
    chart.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    return;
  }
  const left = chart.valToPos(selected[0], 'x');
  const right = chart.valToPos(selected[1], 'x');
  const tall = chart.bbox.height / devicePixelRatio;
  chart.setSelect({ left, width: right - left, top: 0, height: tall }, false);
}

/** uPlot listens to a mouse only: a finger that goes sideways selects as well, one that goes up or down scrolls. */
function selectByFinger(chart: uPlot): void {
  const { over } = chart;
  over.style.touchAction = 'pan-y';
  let start: number | null = null;
  const placeOf = (event: PointerEvent) => event.clientX - over.getBoundingClientRect().left;
  const select = (event: PointerEvent, done: boolean) => {
    if (start === null) return;
    const ends = [start, placeOf(event)].map((x) => Math.max(0, Math.min(over.clientWidth, x)));
    if (done) start = null;
    const left = Math.min(...ends);
    const width = Math.max(...ends) - left;
    if (width >= least) chart.setSelect({ left, width, top: 0, height: over.clientHeight }, done);
  };
  over.addEventListener('pointerdown', (event) => {
    if (event.pointerType === 'touch') start = placeOf(event);
  });
  over.addEventListener('pointermove', (event) => select(event, false));
  over.addEventListener('pointerup', (event) => select(event, true));
  over.addEventListener('pointercancel', () => (start = null));
}

/** Percentages in equal bins, one stepped line a series. Dragging across it selects a range. */
export function HistogramChart(props: HistogramProps) {
  const { series, unit, onSelect, selected } = props;
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const select = useRef(onSelect);
  select.current = onSelect;
  const shown = useRef(selected);
  shown.current = selected;
  const [isDark, isLarge] = [dark.value, largeType.value];

  const draw = (element: HTMLElement): (() => void) => {
    const { bins = 56 } = props;
    const [lo, hi] = props.range ?? coveringRange(series.map((one) => one.histogram));
    const width = (hi - lo) / bins;
    // Edges of the bins, the last one repeated, so that the steps close.
    const x = Float64Array.from({ length: bins + 1 }, (_, i) => lo + i * width);
    const columns = series.map((one) => {
      const shares = rebin(one.histogram, lo, hi, bins);
      return [...shares, shares[bins - 1]];
    });
    const stepped = uPlot.paths.stepped?.({ align: 1 });
    const chart = new uPlot(
      {
        width: element.clientWidth || 300,
        height,
        padding: [6, 10, 0, 0],
        legend: { show: false },
        cursor: {
          y: false,
          points: { show: false },
          drag: { x: select.current !== undefined, y: false, setScale: false },
        },
        scales: {
          x: { time: false, range: [lo, hi] },
          y: { range: (_, __, max) => [0, Math.max(1, max * 1.08)] },
        },
        axes: [
          { ...axisStyle(22), values: (_, ticks) => ticks.map(props.tick ?? short) },
          { ...axisStyle(34), values: (_, ticks) => ticks.map((tick) => `${tick}%`) },
        ],
        series: [
          {},
          ...series.map((one) => {
            const stroke = cssColour(`--chart-${one.tone}`);
            const fill = cssColour(`--chart-${one.tone}-fill`);
            return { label: one.name, stroke, fill, width: 1.5, paths: stepped, points: { show: false } };
          }),
        ],
        hooks: {
          drawClear: [
            (u) => {
              if (!props.band) return;
              const [from, to] = props.band.map((value) => u.valToPos(value, 'x', true));
              const left = Math.max(from, u.bbox.left);
              const right = Math.min(to, u.bbox.left + u.bbox.width);
              u.ctx.fillStyle = cssColour('--line-soft');
              if (right > left) u.ctx.fillRect(left, u.bbox.top, right - left, u.bbox.height);
            },
          ],
          setSelect: [
            (u) => {
              if (!select.current || u.select.width < least) return;
              select.current(u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x'));
            },
          ],
        },
      },
      [x as unknown as number[], ...columns],
      element,
    );
    plot.current = chart;
    if (select.current) selectByFinger(chart);
    const observer = new ResizeObserver(() => {
      chart.setSize({ width: element.clientWidth, height });
      showSelection(chart, shown.current);
    });
    observer.observe(element);
    return () => {
      observer.disconnect();
      chart.destroy();
      plot.current = null;
    };
  };

  // Each in a task of its own: a report brings half a dozen at once.
  useEffect(() => {
    let remove: (() => void) | undefined;
    const timer = setTimeout(() => (remove = host.current ? draw(host.current) : undefined));
    return () => {
      clearTimeout(timer);
      remove?.();
    };
  }, [series, props.range, isDark, isLarge]);

  useEffect(() => {
    if (plot.current) showSelection(plot.current, selected);
  }, [selected?.[0], selected?.[1], series, isDark, isLarge]);

  const summary = series
    .map((one) => `${one.name}: from ${short(one.histogram.lo)} to ${short(one.histogram.hi)} ${unit}`)
    .join('; ');
  return (
    <figure class="histogram">
      <figcaption>
        <span class="histogram-title">{props.title}</span>
        <span class="histogram-unit">
          {unit ? `${unit}, ` : ''}share of {props.of}
        </span>
      </figcaption>
      {series.length > 1 && (
        <div class="histogram-key">
          {series.map((one) => (
            <span key={one.name} class={`key ${one.tone}`}>
              {one.name}
            </span>
          ))}
        </div>
      )}
      <div
        ref={host}
        class={onSelect ? 'chart brushable' : 'chart'}
        role="img"
        aria-label={`${props.title}. ${summary}`}
      />
    </figure>
  );
}
