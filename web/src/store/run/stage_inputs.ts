import type { Recipe, StageName } from '../../engine/contract';
import { stageSpecs } from '../../engine/generated';
import { canonicalJson } from '../../link/canonical';

type AnyStage = (typeof stageSpecs)[number]['name'];
type Group = keyof Recipe;

/** The groups of the recipe that each stage is made from, its own and those of the stages before it. */
const groupsOf = new Map<AnyStage, ReadonlySet<Group>>();
for (const { name, inputs, reads } of stageSpecs) {
  const own = reads.map((path) => path.split('.')[0] as Group);
  groupsOf.set(name, new Set([...inputs.flatMap((before) => [...(groupsOf.get(before) ?? [])]), ...own]));
}

/** Everything of the recipe that a stage's result depends on: where it differs, the stage has to run again. */
export function stageInput(recipe: Recipe, stage: StageName): string {
  const groups = [...(groupsOf.get(stage) ?? [])].sort();
  return canonicalJson(groups.map((group) => (group === 'source' ? sourceOf(recipe) : recipe[group])));
}

/** Where a file can be had changes nothing that is made of it. */
function sourceOf({ source }: Recipe): Recipe['source'] {
  return source.file ? { ...source, file: { ...source.file, url: '' } } : source;
}

/** Whether two recipes ask for the same, in whatever order their fields stand. */
export function sameRecipe(one: Recipe | null, other: Recipe | null): boolean {
  return one === other || (one !== null && other !== null && canonicalJson(one) === canonicalJson(other));
}

/** Whether two recipes ask for the same mesh, whatever is simulated on it. */
export function sameMesh(one: Recipe, other: Recipe | null): boolean {
  return sameRecipe({ ...one, physics: undefined }, other && { ...other, physics: undefined });
}
