/** What labels are called and how they are coloured: by the recipe's legend, else by the file. */
import { computed } from '@preact/signals';
import type { Recipe } from '../../../engine/contract';
import { labelColour } from '../../../geometry/colours';
import { volume } from '../input';
import { editRecipe, recipe } from '../recipe';

export type LegendEntry = Recipe['legend'][number];

const entries = computed(() => new Map(recipe.value?.legend.map((entry) => [entry.label, entry])));
const known = computed(() => new Map(volume.value?.labels.map((entry) => [entry.label, entry])));

export function nameOf(label: number): string {
  if (label === 0) return 'background';
  return entries.value.get(label)?.name || known.value.get(label)?.name || `label ${label}`;
}

export const colourOf = computed(() => {
  const own = entries.value;
  const ofFile = known.value;
  return (label: number): string =>
    own.get(label)?.colour || (ofFile.get(label)?.colour ?? labelColour(label));
});

/** Whether nobody has named any label: neither the file nor the user. */
export const unnamed = computed(() =>
  [...known.value.values()].every(
    ({ label, name }) => !entries.value.get(label)?.name && (!name || name === `label ${label}`),
  ),
);

/** A legend with changes over it; entries that say nothing go. */
export function changedLegend(
  legend: readonly LegendEntry[],
  changes: readonly Partial<LegendEntry>[],
): LegendEntry[] {
  const next = new Map(legend.map((entry) => [entry.label, entry]));
  for (const change of changes) {
    const { label } = change;
    if (label) next.set(label, { ...(next.get(label) ?? { label, name: '', colour: '' }), ...change });
  }
  return [...next.values()].filter(({ name, colour }) => name || colour).sort((a, b) => a.label - b.label);
}

/** Changes names or colours as one step of the history. */
export function editLegend(what: string, changes: readonly Partial<LegendEntry>[], key?: string): void {
  editRecipe(what, (draft) => void (draft.legend = changedLegend(draft.legend, changes)), key);
}
