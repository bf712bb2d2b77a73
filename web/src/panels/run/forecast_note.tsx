import { exceeded, forecast } from '../../store/run/forecast';
import { budgetEdge, budgetTets, fitBudget, tightMemoryMb } from '../../store/run/budget';
import { volume } from '../../store/case/input';
import { report, upToDate } from '../../store/run/report';
import { activity } from '../../store/run/stages';
import { whole } from '../controls/format';
import { changeText, forecastParts, refusal } from './forecast_text';

/** What a run will take, or why it will be refused; nothing where the mesh is there. */
export function ForecastNote() {
  const now = forecast.value;
  if (!now || !volume.value || (upToDate.value && report.value)) return null;
  const { numbers, problem, fresh, was } = now;
  if (!numbers)
    return (
      <span class="forecast caution" title={problem}>
        No forecast: {problem}
      </span>
    );
  const beyond = exceeded.value;
  const [first, ...others] = forecastParts(numbers, beyond);
  const change = fresh ? changeText(numbers, was) : '';
  const caution = beyond.length > 0 || numbers.peak_mb > tightMemoryMb || budgetEdge.value !== null;
  const words = [
    `Forecast: ${[first + change, ...others].join(', ')}.`,
    ...beyond.map(refusal),
    beyond.length > 0 ? 'A run would be refused.' : '',
  ].join(' ');
  return (
    <>
      <span
        class={caution ? 'forecast caution' : 'forecast'}
        aria-busy={!fresh}
        title={words}
        data-testid="forecast"
      >
        <span class="sr">{words}</span>
        <span aria-hidden="true">
          {first}
          {change}
          <span class="forecast-more"> · {others.join(' · ')}</span>
        </span>
      </span>
      {budgetEdge.value !== null && (
        <button
          type="button"
          class="button small"
          data-testid="use-budget"
          title={`All edge lengths times one factor, for ${whole(budgetTets)} tetrahedra`}
          disabled={activity.value !== 'idle'}
          onClick={() => void fitBudget()}
        >
          Use about {budgetEdge.value} mm instead
        </button>
      )}
    </>
  );
}
