import type { Metric, Report } from '../engine/contract';
import { tetMeasures, type TetMeasure } from '../engine/contract';
import { brush, focusTet, stageShown } from '../store/view';
import { sentence, short, unitSign, whole } from './format';
import { Icon } from './icons';

function WorstButton({ metric }: { metric: Metric }) {
  const isTetMeasure = metric.elements === 'tets' && (tetMeasures as readonly string[]).includes(metric.name);
  if (!isTetMeasure || metric.worst.length === 0) return null;
  const fly = () => {
    if (stageShown.value !== 'optimise') stageShown.value = 'quality';
    const at = focusTet.value === null ? -1 : metric.worst.indexOf(focusTet.value);
    brush.value = null;
    focusTet.value = metric.worst[(at + 1) % metric.worst.length];
  };
  return (
    <button
      type="button"
      class="icon-button small"
      aria-label={`Fly to the worst element by ${sentence(metric.name as TetMeasure)}`}
      title="Fly to the worst; again for the next"
      onClick={fly}
    >
      <Icon name="target" size={14} />
    </button>
  );
}

export function MeasuresTable({ found }: { found: Report }) {
  return (
    <section class="section">
      <h2>Measures</h2>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Measures">
        <table class="measures">
          <thead>
            <tr>
              <th scope="col">Measure</th>
              <th scope="col" class="num">
                Min
              </th>
              <th scope="col" class="num">
                Median
              </th>
              <th scope="col" class="num">
                Max
              </th>
              <th scope="col">
                <span class="sr">Worst</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {found.quality.metrics.map((metric) => (
              <tr key={metric.name}>
                <th
                  scope="row"
                  title={`1st percentile ${short(metric.p1)}, 99th ${short(metric.p99)}, mean ${short(metric.mean)}, over ${whole(metric.count)} ${metric.elements}`}
                >
                  {sentence(metric.name)} <span class="unit">{unitSign(metric.unit)}</span>
                </th>
                <td class="num">{short(metric.min)}</td>
                <td class="num">{short(metric.median)}</td>
                <td class="num">{short(metric.max)}</td>
                <td>
                  <WorstButton metric={metric} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
