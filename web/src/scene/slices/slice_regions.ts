import { effect, untracked } from '@preact/signals';
import { movedRegion, pulledRegion, regionDistance, zeroLines, type Region } from '../../geometry/regions';
import { bodiesInView, editBody, isChosen, isPoint, type Body } from '../../store/case/bodies';
import { recipe } from '../../store/case/recipe';
import { bodyShown } from '../../store/view';

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
  body: Body;
  from: number[];
  pulls: boolean;
  key: string;
}

let dragCount = 0;

const bodies = () => untracked(() => bodiesInView(recipe.value));
const chosenBody = () => untracked(() => bodies().find(isChosen));

/** Outlines of regions, stimuli and electrodes in a slice; they are resized by their outlines, and points are moved. */
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
      void bodiesInView(recipe.value);
      void bodyShown.value;
      this.draw();
    });
  }

  draw(): void {
    this.svg.replaceChildren(
      ...bodies().flatMap((body) => {
        const { kind, region, band_mm } = body;
        const look = `is-${kind} ${untracked(() => isChosen(body)) ? 'chosen' : ''}`;
        return [
          ...(band_mm > 0 ? [this.outline(region, band_mm, `band ${look}`)] : []),
          this.outline(region, 0, look),
        ];
      }),
    );
  }

  /** Whether a press at this place of the pane takes hold of a body. */
  take(x: number, y: number): boolean {
    const from = this.plane.mmAt(x, y);
    const reach = grip * this.plane.mmPerPixel();
    const chosen = chosenBody();
    const isNear = ({ region }: Body) => Math.abs(regionDistance(region, from)) < reach;
    const body = chosen && regionDistance(chosen.region, from) < reach ? chosen : bodies().find(isNear);
    if (!body) return false;
    bodyShown.value = { kind: body.kind, index: body.index };
    const pulls = isNear(body) && !isPoint(body.kind);
    this.drag = { body, from, pulls, key: `slice drag ${++dragCount}` };
    return true;
  }

  /** What a press here would do, as a cursor. */
  cursorAt(x: number, y: number): string {
    const body = chosenBody();
    if (!body) return '';
    const away = regionDistance(body.region, this.plane.mmAt(x, y));
    const reach = grip * this.plane.mmPerPixel();
    if (isPoint(body.kind)) return away < reach ? 'move' : '';
    return Math.abs(away) < reach ? 'nwse-resize' : away < 0 ? 'move' : '';
  }

  dragTo(x: number, y: number): boolean {
    if (!this.drag) return false;
    const { body, from, pulls, key } = this.drag;
    const to = this.plane.mmAt(x, y);
    const change = pulls
      ? pulledRegion(body.region, from, to)
      : movedRegion(
          body.region,
          to.map((part, axis) => part - from[axis]),
        );
    editBody(`${pulls ? 'Resize' : 'Move'} ${body.kind}`, body, change, key, Infinity);
    return true;
  }

  release(): void {
    this.drag = null;
  }

  dispose(): void {
    this.stop();
    this.svg.remove();
  }

  private outline(region: Region, away: number, kind: string): SVGPathElement {
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
