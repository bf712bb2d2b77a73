import { effect, signal } from '@preact/signals';
import type { Vec3 } from '../../engine/contract';
import { toIndex } from '../../geometry/orientation';
import { volume } from '../../store/case/input';
import { meshedLabels } from '../../store/case/labels';
import { colourOf, nameOf } from '../../store/case/legend/legend';
import { shownResult } from '../../store/run/results';
import { slicePlaces } from '../../store/view';
import type { SlicePlane } from './slice_regions';

/** The name of the label under the pointer; without one over the slice, of that at the crosshair. */
export class SliceLabel {
  private readonly root: HTMLElement;
  private readonly swatch: HTMLElement;
  private readonly text: HTMLElement;
  private readonly plane: SlicePlane;
  private readonly pointed = signal<Vec3 | null>(null);
  private readonly stop: () => void;

  constructor(parent: HTMLElement, plane: SlicePlane) {
    this.plane = plane;
    this.root = document.createElement('span');
    this.root.className = 'pane-label';
    this.swatch = document.createElement('i');
    this.text = document.createElement('span');
    this.root.append(this.swatch, this.text);
    parent.append(this.root);
    this.stop = effect(() => this.say());
  }

  /** The label of the image at a place, mm; null outside of it. */
  at(mm: Vec3): number | null {
    const known = volume.value;
    return known && this.labelAt(toIndex(known.index_to_mm, mm));
  }

  hover(x: number, y: number): void {
    this.pointed.value = this.plane.mmAt(x, y) as Vec3;
  }

  leave(): void {
    this.pointed.value = null;
  }

  dispose(): void {
    this.stop();
    this.root.remove();
  }

  private labelAt(index: readonly number[]): number | null {
    const labels = shownResult('volume')?.labels;
    const size = volume.value?.size;
    if (!labels || !size) return null;
    const [i, j, k] = index.map(Math.round);
    if (i < 0 || j < 0 || k < 0 || i >= size[0] || j >= size[1] || k >= size[2]) return null;
    return labels[i + size[0] * (j + size[1] * k)] ?? null;
  }

  private say(): void {
    const known = volume.value;
    const pointed = this.pointed.value;
    const crosshair = slicePlaces.value.map((place, axis) => place * ((known?.size[axis] ?? 1) - 1));
    const label = pointed ? this.at(pointed) : this.labelAt(crosshair);
    this.root.hidden = label === null;
    if (label === null) return;
    const idle = label > 0 && !meshedLabels.value.has(label);
    this.text.textContent = nameOf(label) + (idle ? ', not meshed' : '');
    this.swatch.style.background = label > 0 ? colourOf.value(label) : 'transparent';
  }
}
