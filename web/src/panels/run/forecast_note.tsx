import { exceeded, forecast } from '../../store/run/forecast';
import { volume } from '../../store/case/input';
import { report, upToDate } from '../../store/run/report';
import { forecastParts, refusal } from './forecast_text';

/** The engine's memory ends at 4295 MB, and forecasts of it hold within a quarter. */
export const tightMemoryMb = 3300;

/** What a run will take, or why it will be refused; nothing where the mesh is there. */
export function ForecastNote() {
  const now = forecast.value;
  if (!now || !volume.value || (upToDate.value && report.value)) return null;
  const { numbers, problem, fresh } = now;
  if (!numbers)
    return (
      <span class="forecast caution" title={problem}>
        No forecast: {problem}
      </span>
    );
  const beyond = exceeded.value;
  const [first, ...others] = forecastParts(numbers, beyond);
  const caution = beyond.length > 0 || numbers.peak_mb > tightMemoryMb;
  const words = [
    `Forecast: ${[first, ...others].join(', ')}.`,
    ...beyond.map(refusal),
    beyond.length > 0 ? 'A run would be refused.' : '',
  ].join(' ');
  return (
    <span
      class={caution ? 'forecast caution' : 'forecast'}
      aria-busy={!fresh}
      title={words}
      data-testid="forecast"
    >
      <span class="sr">{words}</span>
      <span aria-hidden="true">
        {first}
        <span class="forecast-more"> · {others.join(' · ')}</span>
      </span>
    </span>
  );
}
