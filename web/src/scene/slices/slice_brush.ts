import { effect } from '@preact/signals';
import { beginStroke, brushTool, continueStroke, dropStroke, endStroke } from '../../store/case/painting';
import type { SlicePlane } from './slice_regions';

/** The brush on a slice: its outline under the pointer, and strokes. */
export class SliceBrush {
  private readonly ring: HTMLElement;
  private readonly plane: SlicePlane;
  private readonly stop: () => void;
  private at: [number, number] | null = null;

  constructor(parent: HTMLElement, plane: SlicePlane) {
    this.plane = plane;
    this.ring = document.createElement('i');
    this.ring.className = 'brush-ring';
    parent.append(this.ring);
    this.stop = effect(() => {
      void brushTool.value;
      this.draw();
    });
  }

  get on(): boolean {
    return brushTool.peek().on;
  }

  take(x: number, y: number, across: number): void {
    this.hover(x, y);
    beginStroke(this.plane.mmAt(x, y), across);
  }

  dragTo(x: number, y: number): void {
    this.hover(x, y);
    continueStroke(this.plane.mmAt(x, y));
  }

  release(): void {
    endStroke();
  }

  takeBack(): void {
    dropStroke();
    this.leave();
  }

  /** One dab at a place of the patient. */
  dab(mm: readonly number[], across: number): void {
    beginStroke(mm, across);
    endStroke();
  }

  hover(x: number, y: number): void {
    this.at = [x, y];
    this.draw();
  }

  leave(): void {
    this.at = null;
    this.draw();
  }

  dispose(): void {
    this.stop();
    this.ring.remove();
  }

  private draw(): void {
    const { on, erases, radius_mm } = brushTool.peek();
    this.ring.hidden = !on || !this.at;
    if (!on || !this.at) return;
    const radius = radius_mm / this.plane.mmPerPixel();
    this.ring.classList.toggle('erases', erases);
    this.ring.style.width = this.ring.style.height = `${(2 * radius).toFixed(1)}px`;
    const [x, y] = this.at.map((part) => (part - radius).toFixed(1));
    this.ring.style.transform = `translate(${x}px, ${y}px)`;
  }
}
