import type { Report } from '../../engine/contract';
import { dialogShown } from '../controls/dialog_shown';
import { sentence, short, unitSign, whole } from '../controls/format';

export function MeasuresTable({ found }: { found: Report }) {
  return (
    <section class="section">
      <div class="section-head">
        <h2>Measures</h2>
        <button type="button" class="button small" onClick={() => (dialogShown.value = 'glossary')}>
          What they mean…
        </button>
      </div>
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
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
