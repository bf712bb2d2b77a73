import type { Forecast, Recipe } from '../../engine/contract';
import type { Exceeded } from '../../store/run/forecast';
import { about } from '../controls/format';

type Limited = keyof Recipe['limits'];

/** A number of a forecast, as exactly as it is known. */
export function amount(field: Limited, value: number): string {
  if (field === 'tets') return `${about(value)} tetrahedra`;
  if (field === 'memory_mb') return `${about(value)} MB`;
  if (value >= 90) return `${Math.round(value / 60)} min`;
  return `${Math.max(1, Math.round(value))} s`;
}

/** Tetrahedra, memory and time; with the limit where one is exceeded. */
export function forecastParts(numbers: Forecast, exceeded: readonly Exceeded[]): string[] {
  const part = (field: Limited, value: number) => {
    const beyond = exceeded.find((one) => one.field === field);
    return amount(field, value) + (beyond ? ` (limit ${limitOf(beyond)})` : '');
  };
  const beyondTime = exceeded.some(({ field }) => field === 'seconds');
  return [
    `about ${part('tets', numbers.tets)}`,
    part('memory_mb', numbers.peak_mb),
    beyondTime ? part('seconds', numbers.seconds) : span(numbers.seconds_here),
  ];
}

/** "3 to 7 s", "4 to 9 min". */
export function span([least, most]: readonly [number, number]): string {
  const minutes = most >= 120;
  const [from, to] = [least, most].map((value) => Math.max(1, Math.round(minutes ? value / 60 : value)));
  return `${from === to ? from : `${from} to ${to}`} ${minutes ? 'min' : 's'}`;
}

/** How the number of tetrahedra has changed with the last step: nothing where there was none. */
export function changeText(numbers: Forecast, was: Forecast | null): string {
  if (!was) return '';
  const [now, before] = [about(numbers.tets), about(was.tets)];
  return now === before ? ' (as before)' : ` (was ${before})`;
}

const units: Record<Limited, string> = { tets: '', memory_mb: ' MB', seconds: ' s' };

/** As it was set: a limit is exact. */
function limitOf({ field, limit }: Exceeded): string {
  return limit.toLocaleString('en') + units[field];
}

/** Why the engine will refuse a case, with the field's name as it stands in the recipe. */
export function refusal(beyond: Exceeded): string {
  const { field, found } = beyond;
  return `limits.${field}: the forecast is about ${amount(field, found)}, the limit ${limitOf(beyond)}.`;
}
