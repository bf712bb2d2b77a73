import { computed } from '@preact/signals';
import type { Recipe } from '../../engine/contract';
import { volume } from './input';
import { recipe } from './recipe';

/** The labels of the volume that are meshed: all where the recipe names none. */
export const meshedLabels = computed<ReadonlySet<number>>(() => {
  const chosen = recipe.value?.labels ?? [];
  return new Set(chosen.length > 0 ? chosen : volume.value?.labels.map(({ label }) => label));
});

/** Groups of labels that are meshed as one region, which carries the smallest: `merge` of the recipe. */
type Groups = readonly (readonly number[])[];

/** Whether all chosen labels are one group. */
export function mergesAll(groups: Groups, chosen: readonly number[]): boolean {
  return groups.length === 1 && chosen.every((label) => groups[0].includes(label));
}

/** The groups once other labels are chosen: one of all stays one of all; others lose what is left out. */
export function groupsOf(groups: Groups, before: readonly number[], chosen: readonly number[]): number[][] {
  if (mergesAll(groups, before)) return [[...chosen]];
  return groups
    .map((group) => group.filter((label) => chosen.includes(label)))
    .filter((group) => group.length > 0);
}

/** The label that the region of `label` carries. */
export function carrierOf(groups: Groups, label: number): number {
  return Math.min(...(groups.find((group) => group.includes(label)) ?? [label]));
}

/** The labels that regions of the mesh carry. */
export function carriersOf(groups: Groups, chosen: readonly number[]): number[] {
  return chosen.filter((label) => carrierOf(groups, label) === label);
}

/** The groups once `label` shares the region of `other`; with itself as the other, it has its own. */
export function groupedWith(groups: Groups, label: number, other: number): number[][] {
  const left = groups.map((group) => group.filter((one) => one !== label));
  const at = left.findIndex((group) => group.includes(other));
  const joined = [...(at < 0 ? [other] : left[at]), label].sort((a, b) => a - b);
  const rest = left.filter((group, index) => index !== at && group.length > 1);
  return other === label ? rest : [...rest, joined].sort((a, b) => a[0] - b[0]);
}

/** Takes away target sizes of labels that have no region of their own among those chosen. */
export function dropIdleSizes(draft: Recipe, chosen: readonly number[]): void {
  const carriers = carriersOf(draft.merge, chosen);
  const carries = ({ label }: { label: number }) => carriers.includes(label);
  const { sizing } = draft;
  sizing.labels = sizing.labels.filter(carries);
  sizing.distances = sizing.distances.filter(carries);
  // A size for no label at all is one for all labels.
  sizing.curvature = sizing.curvature
    .filter(({ labels }) => labels.length === 0 || labels.some((label) => carriers.includes(label)))
    .map((size) => ({ ...size, labels: size.labels.filter((label) => carriers.includes(label)) }));
}
