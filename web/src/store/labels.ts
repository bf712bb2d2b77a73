/** Groups of labels that are meshed as one region: `merge` of the recipe. */
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
