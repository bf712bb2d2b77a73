/** What labels may be by how they lie to each other: backgrounds, walls and what is inside of them. */
import type { Recipe, Surroundings, VolumeSummary } from '../../../engine/contract';

/** A label that has more of the image's border than this may be its background. */
const mostOfBorder = 0.5;
/** A label belongs to another that has so much of its boundary. */
const enclosed = 0.4;

type Known = Pick<VolumeSummary, 'labels' | 'surroundings'>;

/** A label that is meshed, though it may be the background. */
export function likelyBackground({ surroundings = [] }: Known, chosen: readonly number[]): number | null {
  const found = surroundings.find(({ border_share }) => border_share > mostOfBorder);
  return found && chosen.length > 1 && chosen.includes(found.label) ? found.label : null;
}

function shareOf(around: Surroundings | undefined, label: number): number {
  return around?.contacts.find((contact) => contact.label === label)?.share ?? 0;
}

/**
 * The labels that may form a wall, and those on its inner side. The inside is the largest label that another one
 * encloses, of those that are not meshed where there are such. What else lies mostly in the wall is a part of it, as a
 * scar is. `taken` are inside of other walls. Without an inside the wall is the largest label, around cavities of the background.
 */
export function likelyWall(
  { labels, surroundings = [] }: Known,
  chosen: readonly number[],
  taken: readonly number[] = [],
) {
  const meshed = chosen.length > 0 ? chosen : labels.map(({ label }) => label);
  const around = new Map(surroundings.map((one) => [one.label, one]));
  const mayBeInside = ({ label }: { label: number }) =>
    (around.get(label)?.border_share ?? 0) <= mostOfBorder && !taken.includes(label);
  const sorted = [...labels].sort((a, b) => b.voxels - a.voxels);
  const bySize = sorted.filter(mayBeInside).map(({ label }) => label);
  const left = bySize.filter((label) => !meshed.includes(label));
  const ownerOf = (label: number): number | null => {
    const contact = around.get(label)?.contacts.find((one) => one.label !== 0 && meshed.includes(one.label));
    return contact && contact.share >= enclosed ? contact.label : null;
  };
  for (const inner of left.length > 0 ? left : bySize) {
    const owner = ownerOf(inner);
    if (owner === null || owner === inner) continue;
    const within = meshed.filter(
      (label) => label !== owner && label !== inner && shareOf(around.get(label), owner) >= enclosed,
    );
    return { wall: [owner, ...within].sort((a, b) => a - b), inner: [inner] };
  }
  const largest = sorted.find(({ label }) => meshed.includes(label));
  return { wall: [largest?.label ?? 1], inner: [] as number[] };
}

/** Leaves a label out of the mesh. */
export function leaveOut(label: number, labels: readonly number[], draft: Recipe): void {
  const chosen = draft.labels.length > 0 ? draft.labels : labels;
  draft.labels = chosen.filter((one) => one !== label);
}
