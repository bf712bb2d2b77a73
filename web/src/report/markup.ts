/** Parts of a page as HTML text: nothing of what they are given becomes markup. */
import { coveringRange, rebin } from '../geometry/histogram';
import type { Series } from './charts';

const escapes: Record<string, string> = {
  '&': '&amp;',
  '<': '&lt;',
  '>': '&gt;',
  '"': '&quot;',
  "'": '&#39;',
};

export function escaped(text: string): string {
  return text.replace(/[&<>"']/g, (sign) => escapes[sign]);
}

export const number = (value: number): string =>
  Number.isFinite(value) ? String(Number(value.toPrecision(4))) : '–';
export const whole = (value: number): string => Math.round(value).toLocaleString('en');

/** `numbers`: how many columns after the first hold numbers. */
export function table(heads: readonly string[], rows: readonly string[][], numbers = 0): string {
  const cell = (tag: string, text: string, i: number) =>
    `<${tag}${i > 0 && i <= numbers ? ' class="num"' : ''}>${escaped(text)}</${tag}>`;
  const head = heads.map((text, i) => cell('th', text, i)).join('');
  const body = rows.map((row) => `<tr>${row.map((text, i) => cell('td', text, i)).join('')}</tr>`).join('\n');
  return `<table><thead><tr>${head}</tr></thead><tbody>\n${body}\n</tbody></table>`;
}

/** Colours of series; `toneStyle` gives them to their names. */
const tones: Record<Series['tone'], string> = { now: '#0b6b72', before: '#b0741a', pinned: '#6b4fa0' };
const [chartWidth, chartHeight, chartBins] = [420, 120, 56];

/** Shares of each series in equal bins, as stepped outlines. */
export function histogramSvg(title: string, unit: string, series: readonly Series[]): string {
  const [lo, hi] = coveringRange(series.map(({ histogram }) => histogram));
  const shares = series.map(({ histogram }) => [...rebin(histogram, lo, hi, chartBins)]);
  const top = Math.max(1, ...shares.flat());
  const paths = shares.map((values, i) => {
    const steps = values.map((share, bin) => {
      const y = number(chartHeight - (share / top) * (chartHeight - 8));
      return `L${number((bin * chartWidth) / chartBins)} ${y}H${number(((bin + 1) * chartWidth) / chartBins)}`;
    });
    const colour = tones[series[i].tone];
    return `<path d="M0 ${chartHeight}${steps.join('')}V${chartHeight}Z" fill="${colour}" fill-opacity=".18" stroke="${colour}"/>`;
  });
  const ticks = [0, 0.25, 0.5, 0.75, 1].map(
    (t) =>
      `<text x="${t * chartWidth}" y="${chartHeight + 14}" text-anchor="${t === 0 ? 'start' : t === 1 ? 'end' : 'middle'}">${number(Number((lo + t * (hi - lo)).toPrecision(3)))}</text>`,
  );
  const key = series.map(({ name, tone }) => `<span class="${tone}">■ ${escaped(name)}</span>`).join(' ');
  return `<figure><figcaption><b>${escaped(title)}</b> ${escaped(unit)} ${key}</figcaption>
<svg viewBox="0 -4 ${chartWidth} ${chartHeight + 22}" role="img" aria-label="${escaped(title)}">${paths.join('')}<path d="M0 ${chartHeight}H${chartWidth}" stroke="#8b97a5"/>${ticks.join('')}</svg></figure>`;
}

export const toneStyle = Object.entries(tones)
  .map(([tone, colour]) => `.${tone}{color:${colour}}`)
  .join('');
