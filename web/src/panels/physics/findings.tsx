import type { Simulated } from '../../engine/contract';
import { simulated } from '../../store/run/frames';
import { heartIsPlayed } from '../../store/run/beat/heartbeat';
import { labelColour } from '../../geometry/colours';
import { TraceChart } from './trace_chart';

const ms = (value: number): string => `${value.toFixed(0)} ms`;

type Potentials = NonNullable<NonNullable<Simulated['monodomain']>['traces']>;

/** The potential at each electrode over time. */
function Electrograms({ traces }: { traces: Potentials }) {
  return (
    <TraceChart
      name="Electrograms, mV over ms"
      label={`Potentials of ${traces.electrodes.map(({ title }) => title).join(', ')}`}
      timesMs={traces.times_ms}
      lines={traces.electrodes.map(({ title, values }, i) => ({
        title,
        values,
        colour: labelColour(i + 1),
      }))}
      seeks={!heartIsPlayed.value}
    />
  );
}

/** What the last simulations of this mesh found, in words. */
export function Findings() {
  const { eikonal, monodomain } = simulated.value;
  const lines: [string, string][] = [];
  if (eikonal) lines.push(['Activation map, last point', ms(eikonal.last_ms)]);
  if (monodomain) {
    const { activated, total_activation_ms, mean_apd_ms, most_activations, lasted_ms } = monodomain;
    lines.push([
      'Activated',
      `${(100 * activated).toFixed(activated < 1 ? 1 : 0)} % within ${ms(total_activation_ms)}`,
    ]);
    if (mean_apd_ms) lines.push(['Action potential', ms(mean_apd_ms)]);
    if (most_activations > 1) lines.push(['Beats of a point, most', String(most_activations)]);
    lines.push(['Activity after the last stimulus', ms(lasted_ms)]);
  }
  if (lines.length === 0) return null;
  return (
    <>
      <dl class="findings">
        {lines.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      {monodomain?.traces && <Electrograms traces={monodomain.traces} />}
    </>
  );
}
