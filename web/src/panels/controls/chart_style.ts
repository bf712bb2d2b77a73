/** What charts have in common. */

export function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** Of the axes, in the colours of the theme as it is now. */
export const axisStyle = () => ({
  stroke: cssColour('--text-soft'),
  font: '11px "Inter Variable", system-ui, sans-serif',
  grid: { stroke: cssColour('--line-soft'), width: 1 },
  ticks: { show: false },
});
