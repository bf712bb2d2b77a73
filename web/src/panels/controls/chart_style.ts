/** What charts have in common. */

export function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** Of an axis, in the colours of the theme and the size of type as they are now; `size` px across at normal type. */
export function axisStyle(size: number) {
  const scale = Number(cssColour('--type')) || 1;
  return {
    stroke: cssColour('--text-soft'),
    font: `${11 * scale}px "Inter Variable", system-ui, sans-serif`,
    grid: { stroke: cssColour('--line-soft'), width: 1 },
    ticks: { show: false },
    size: size * scale,
    gap: 4,
  };
}
