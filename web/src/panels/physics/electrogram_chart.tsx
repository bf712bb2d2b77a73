import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import type { Simulated } from '../../engine/contract';
import { labelColour } from '../../geometry/colours';
import { seek } from '../../store/run/player';
import { dark, largeType, time } from '../../store/view';
import { axisStyle } from '../controls/chart_style';
import { short } from '../controls/format';

type Traces = NonNullable<NonNullable<Simulated['monodomain']>['traces']>;

const height = 130;

/** The potential at each electrode over time, with the time cursor; a click moves it. */
export function ElectrogramChart({ traces }: { traces: Traces }) {
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const [isDark, isLarge] = [dark.value, largeType.value];
  useEffect(() => {
    const element = host.current;
    if (!element) return;
    void [isDark, isLarge];
    const chart = new uPlot(
      {
        width: element.clientWidth || 260,
        height,
        padding: [6, 8, 0, 0],
        legend: { show: false },
        cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
        scales: { x: { time: false } },
        axes: [
          { ...axisStyle(22), values: (_, ticks) => ticks.map((tick) => short(tick)) },
          { ...axisStyle(38), values: (_, ticks) => ticks.map((tick) => short(tick)) },
        ],
        series: [
          {},
          ...traces.electrodes.map(({ title }, i) => ({
            label: title,
            stroke: labelColour(i + 1),
            width: 1.5,
            points: { show: false },
          })),
        ],
      },
      [traces.times_ms, ...traces.electrodes.map(({ values }) => values)],
      element,
    );
    chart.over.addEventListener('click', () => {
      const { left } = chart.cursor;
      if (left !== undefined && left >= 0) seek(chart.posToVal(left, 'x'));
    });
    plot.current = chart;
    return () => {
      plot.current = null;
      chart.destroy();
    };
  }, [traces, isDark, isLarge]);
  const now = time.value;
  useEffect(() => {
    const chart = plot.current;
    if (chart) chart.setCursor({ left: chart.valToPos(now, 'x'), top: 0 }, false);
  }, [now, traces, isDark, isLarge]);
  const titles = traces.electrodes.map(({ title }) => title).join(', ');
  return (
    <figure class="electrograms">
      <figcaption>
        Electrograms, mV over ms
        {traces.electrodes.map(({ title }, i) => (
          <span key={title} class="electrogram-name">
            <i style={{ background: labelColour(i + 1) }} /> {title}
          </span>
        ))}
      </figcaption>
      <div ref={host} class="electrogram" role="img" aria-label={`Potentials of ${titles}`} />
    </figure>
  );
}
