import { effect } from '@preact/signals';
import type { SizeRegion } from '../../engine/contract';
import { movedRegion, pulledRegion, regionDistance, zeroLines } from '../../geometry/regions';
import { editRecipe, recipe } from '../../store/case/recipe';
import { regionShown } from '../../store/view';

const svgNamespace = 'http://www.w3.org/2000/svg';
/** Pixels of the lattice on which outlines are found. */
const lattice = 5;
/** Pixels within which a click means the outline. */
const grip = 7;

/** How a slice maps pixels of its pane to patient millimetres. */
export interface SlicePlane {
  size(): [number, number];
  mmPerPixel(): number;
  /** In the plane of the slice. */
  mmAt(x: number, y: number): number[];
}

interface Drag {
  index: number;
  region: SizeRegion;
  from: number[];
  pulls: boolean;
  key: string;
}

let dragCount = 0;

/** Outlines of the sizing regions in a slice; the chosen one can be moved by its inside and resized by its outline. */
export class SliceRegions {
  private readonly svg: SVGSVGElement;
  private readonly plane: SlicePlane;
  private readonly stop: () => void;
  private drag: Drag | null = null;

  constructor(parent: HTMLElement, plane: SlicePlane) {
    this.plane = plane;
    this.svg = document.createElementNS(svgNamespace, 'svg');
    this.svg.setAttribute('class', 'slice-regions');
    this.svg.setAttribute('aria-hidden', 'true');
    parent.append(this.svg);
    this.stop = effect(() => {
      void recipe.value?.sizing.regions;
      void regionShown.value;
      this.draw();
    });
  }

  draw(): void {
    const regions = recipe.peek()?.sizing.regions ?? [];
    const chosen = regionShown.peek();
    this.svg.replaceChildren(
      ...regions.flatMap((region, index) => {
        const kind = index === chosen ? 'chosen' : '';
        return [
          ...(region.band_mm > 0 ? [this.outline(region, region.band_mm, `band ${kind}`)] : []),
          this.outline(region, 0, kind),
        ];
      }),
    );
  }

  /** Whether a press at this place of the pane takes hold of a region. */
  take(x: number, y: number): boolean {
    const regions = recipe.peek()?.sizing.regions ?? [];
    const from = this.plane.mmAt(x, y);
    const reach = grip * this.plane.mmPerPixel();
    const chosen = regionShown.peek();
    const near = regions.findIndex((region) => Math.abs(regionDistance(region, from)) < reach);
    const own = chosen !== null && regions[chosen] ? regionDistance(regions[chosen], from) : Infinity;
    const index = own < reach ? chosen : near < 0 ? null : near;
    if (index === null) return false;
    regionShown.value = index;
    const region = regions[index];
    const pulls = Math.abs(regionDistance(region, from)) < reach;
    this.drag = { index, region, from, pulls, key: `slice drag ${++dragCount}` };
    return true;
  }

  /** What a press here would do, as a cursor. */
  cursorAt(x: number, y: number): string {
    const region = recipe.peek()?.sizing.regions[regionShown.peek() ?? -1];
    if (!region) return '';
    const away = regionDistance(region, this.plane.mmAt(x, y));
    const reach = grip * this.plane.mmPerPixel();
    return Math.abs(away) < reach ? 'nwse-resize' : away < 0 ? 'move' : '';
  }

  dragTo(x: number, y: number): boolean {
    if (!this.drag) return false;
    const { index, region, from, pulls, key } = this.drag;
    const to = this.plane.mmAt(x, y);
    const change = pulls
      ? pulledRegion(region, from, to)
      : movedRegion(
          region,
          to.map((part, axis) => part - from[axis]),
        );
    editRecipe(
      pulls ? 'Resize region' : 'Move region',
      (draft) => void Object.assign(draft.sizing.regions[index], change),
      key,
      Infinity,
    );
    return true;
  }

  release(): void {
    this.drag = null;
  }

  dispose(): void {
    this.stop();
    this.svg.remove();
  }

  private outline(region: SizeRegion, away: number, kind: string): SVGPathElement {
    const [width, height] = this.plane.size();
    const lines = zeroLines(
      (x, y) => regionDistance(region, this.plane.mmAt(x, y)) - away,
      width,
      height,
      lattice,
    );
    let path = '';
    for (let i = 0; i < lines.length; i += 4) {
      const [x1, y1, x2, y2] = lines.slice(i, i + 4).map((part) => part.toFixed(1));
      path += `M${x1} ${y1}L${x2} ${y2}`;
    }
    const element = document.createElementNS(svgNamespace, 'path');
    element.setAttribute('class', kind);
    element.setAttribute('d', path);
    return element;
  }
}
