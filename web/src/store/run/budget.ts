/** How many tetrahedra a first look may have, and the edge lengths that give them. */
import { computed } from '@preact/signals';
import { recipe } from '../case/recipe';
import { tellError } from './engine';
import { fitSizes, forecast, useSizes } from './forecast';

/** Meshed within a minute or two in a tab, and drawn without delay. */
export const budgetTets = 500_000;
/** A tab has 4,295 MB, and forecasts of memory hold within a quarter. */
export const tightMemoryMb = 3300;
/** So many edges cubed fill a volume with as many tetrahedra: 8.6 to 10.2 on hearts and a torso of 61 labels. */
const tetsPerCube = 10;

/** The edge length that fills a volume (mm³) with so many tetrahedra, mm. */
export const edgeFor = (volume: number, tets: number): number => Math.cbrt((tetsPerCube * volume) / tets);

/** About the edge length that is within the budget, where the case is far beyond it or will not fit, mm. */
export const budgetEdge = computed(() => {
  const numbers = forecast.value?.fresh ? forecast.value.numbers : null;
  if (!numbers || !recipe.value) return null;
  if (numbers.tets < 2 * budgetTets && numbers.peak_mb < tightMemoryMb) return null;
  const edge = recipe.value.sizing.edge_mm * Math.cbrt(numbers.tets / budgetTets);
  return numbers.tets > budgetTets ? Number(edge.toPrecision(2)) : null;
});

/** All edge lengths times the one factor that keeps the budget, as a step that can be undone. */
export async function fitBudget(): Promise<void> {
  try {
    useSizes(await fitSizes(budgetTets, new AbortController().signal), budgetTets);
  } catch (error) {
    tellError(error);
  }
}
