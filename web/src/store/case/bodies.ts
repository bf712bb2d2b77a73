/** What a case places in the patient: regions of sizes, stimuli, electrodes. Views draw them and drag them alike. */
import type { Recipe, RegionShape, SizeRegion, Vec3 } from '../../engine/contract';
import type { Region } from '../../geometry/regions';
import { simulation } from '../run/frames';
import { bodyShown, gizmoMode, type BodyKind, type BodyName } from '../view';
import { meshIsGiven, volume } from './input';
import { editRecipe, recipe } from './recipe';

export interface Body extends BodyName {
  region: Region;
  /** Around it sizes change for so long, mm. */
  band_mm: number;
}

/** An electrode is a point; it is drawn as a small ball. */
const ballAt = (centre_mm: Vec3): Region => ({
  shape: 'sphere',
  centre_mm,
  radius_mm: 2,
  end_mm: centre_mm,
  half_size_mm: [2, 2, 2],
  axes_deg: [0, 0, 0],
});

const electrodesOf = (recipe: Recipe) => recipe.physics?.monodomain?.electrodes ?? [];

export function bodiesOf(recipe: Recipe | null): Body[] {
  if (!recipe) return [];
  return [
    ...recipe.sizing.regions.map(
      (region, index): Body => ({
        kind: 'region',
        index,
        region,
        band_mm: region.band_mm,
      }),
    ),
    ...(recipe.physics?.stimuli ?? []).map(
      (region, index): Body => ({
        kind: 'stimulus',
        index,
        region,
        band_mm: 0,
      }),
    ),
    ...electrodesOf(recipe).map(
      ({ at_mm }, index): Body => ({
        kind: 'electrode',
        index,
        region: ballAt(at_mm),
        band_mm: 0,
      }),
    ),
  ];
}

export const isChosen = ({ kind, index }: BodyName): boolean =>
  bodyShown.value?.kind === kind && bodyShown.value.index === index;

/** Bodies to be drawn: where frames are played, stimuli and electrodes would lie over them. */
export function bodiesInView(recipe: Recipe | null): Body[] {
  const clear = simulation.value === 'none';
  return bodiesOf(recipe).filter((body) => clear || body.kind === 'region' || isChosen(body));
}

/** Only its place can be changed. */
export const isPoint = (kind: BodyKind): boolean => kind === 'electrode';

/** Moves or reshapes a body, as one step of the history with others of the same key. */
export function editBody(
  label: string,
  { kind, index }: BodyName,
  change: Partial<Region>,
  key: string,
  patienceMs?: number,
): void {
  editRecipe(
    label,
    (draft) => {
      if (kind === 'region') Object.assign(draft.sizing.regions[index], change);
      else if (kind === 'stimulus') Object.assign(draft.physics?.stimuli[index] ?? {}, change);
      else if (change.centre_mm) electrodesOf(draft)[index].at_mm = change.centre_mm;
    },
    key,
    patienceMs,
  );
}

/** How long the image is, mm. */
function imageExtent(): number {
  const known = volume.value;
  return known ? Math.max(...known.size.map((size, axis) => size * known.spacing_mm[axis])) : 60;
}

function newRegion(shape: RegionShape, centre: Vec3, { sizing }: Recipe): SizeRegion {
  const radius = Math.max(1, Math.round(imageExtent() / 8));
  return {
    name: `Region ${sizing.regions.length + 1}`,
    shape,
    centre_mm: centre,
    end_mm: [centre[0], centre[1], centre[2] + 2 * radius],
    half_size_mm: [radius, radius, radius],
    axes_deg: [0, 0, 0],
    radius_mm: radius,
    edge_mm: Number((sizing.edge_mm / 2).toPrecision(2)),
    band_mm: 5,
  };
}

/** Adds a region with an edge length of its own, its middle at a place, mm; its fields and handles are shown. */
export function addRegion(shape: RegionShape, centre: Vec3): void {
  const current = recipe.value;
  // A mesh that was made elsewhere has no sizes.
  if (!current || meshIsGiven.value) return;
  const place = centre.map((x) => Math.round(10 * x) / 10) as Vec3;
  editRecipe(`Add ${shape}`, (draft) => void draft.sizing.regions.push(newRegion(shape, place, current)));
  bodyShown.value = { kind: 'region', index: current.sizing.regions.length };
  gizmoMode.value = 'translate';
}
