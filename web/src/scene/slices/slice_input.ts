import { toIndex, type SliceFrame } from '../../geometry/orientation';
import type { Grid } from '../../geometry/grid_values';
import type { Vec3 } from '../../engine/contract';
import { addRegion } from '../../store/case/bodies';
import { chooseLayout, labelPicked, slicePlaces, slicesFirst } from '../../store/view';
import type { SliceBrush } from './slice_brush';
import type { SliceLabel } from './slice_label';
import type { SliceRegions } from './slice_regions';
import { SliceTouch } from './slice_touch';

/** What pointer, wheel and keys do something to: a slice as it stands. */
export interface SteeredSlice {
  readonly surface: HTMLElement;
  readonly slider: HTMLInputElement;
  readonly regions: SliceRegions;
  readonly brush: SliceBrush;
  readonly label: SliceLabel;
  readonly frame: SliceFrame;
  readonly grid: Grid;
  /** The crosshair, mm. */
  readonly centre: Vec3;
  /** The number of the slice across its axis. */
  readonly index: number;
  /** Patient millimetres of a place of the pane, in the plane of the slice. */
  mmAt(px: number, py: number): Vec3;
  /** About a place of the pane, or its middle. */
  zoomBy(factor: number, about?: [number, number]): void;
  /** Moves the image under the pane by so many pixels. */
  shiftBy(px: number, py: number): void;
  /** The whole image, unshifted. */
  reset(): void;
}

const clamped = (x: number) => Math.max(0, Math.min(1, x));

/** Whoever works on a slice keeps it, also when the first surface comes. */
function keepSlices(): void {
  if (slicesFirst.peek()) chooseLayout('slices');
}

/** Pointer, wheel and keys over a slice: they move the crosshair, the image, regions and the brush. */
export class SliceInput {
  private readonly pane: SteeredSlice;

  constructor(pane: SteeredSlice) {
    this.pane = pane;
    this.listen();
  }

  private aim(px: number, py: number): void {
    const { size, indexToMm } = this.pane.grid;
    const mm = this.pane.mmAt(px, py);
    const index = toIndex(indexToMm, mm);
    slicePlaces.value = slicePlaces.peek().map((old, axis) => {
      if (axis === this.pane.frame.across || size[axis] < 2) return old;
      return clamped(Math.round(index[axis]) / (size[axis] - 1));
    }) as Vec3;
    labelPicked.value = this.pane.label.at(mm) || null;
  }

  private step(axis: number, voxels: number): void {
    const last = this.pane.grid.size[axis] - 1;
    if (last < 1) return;
    slicePlaces.value = slicePlaces
      .peek()
      .map((old, i) => (i === axis ? clamped((Math.round(old * last) + voxels) / last) : old)) as Vec3;
  }

  private listen(): void {
    const { surface, slider, regions, brush, label } = this.pane;
    const touch = new SliceTouch(this.pane);
    let held: 'aim' | 'shift' | 'region' | 'brush' | null = null;
    let before = slicePlaces.peek();
    const placeOf = (event: MouseEvent): [number, number] => {
      const box = surface.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    const press = (event: PointerEvent, at: [number, number]) => {
      before = slicePlaces.peek();
      if (event.button !== 0 || event.shiftKey) held = 'shift';
      else held = brush.on ? 'brush' : regions.take(...at) ? 'region' : 'aim';
      if (held === 'aim') this.aim(...at);
      else if (held === 'brush') brush.take(...at, this.pane.frame.across);
    };
    /** What the first finger has begun was not meant where a second one comes. */
    const takeBack = () => {
      if (held === 'brush') brush.takeBack();
      else if (held === 'aim') slicePlaces.value = before;
      regions.release();
      held = null;
    };
    surface.addEventListener('pointerdown', (event) => {
      const at = placeOf(event);
      surface.setPointerCapture(event.pointerId);
      keepSlices();
      if (touch.down(event, at)) takeBack();
      else if (!touch.pinching) press(event, at);
    });
    surface.addEventListener('pointermove', (event) => {
      const at = placeOf(event);
      if (touch.move(event, at)) return;
      if (held === null) label.hover(...at);
      if (held === null && brush.on) brush.hover(...at);
      else if (held === null) surface.style.cursor = regions.cursorAt(...at);
      else if (held === 'brush') brush.dragTo(...at);
      else if (held === 'region') regions.dragTo(...at);
      else if (held === 'aim') this.aim(...at);
      else if (held === 'shift') this.pane.shiftBy(event.movementX, event.movementY);
    });
    const release = (event: PointerEvent) => {
      touch.up(event);
      if (held === 'brush') brush.release();
      held = null;
      regions.release();
    };
    surface.addEventListener('pointerleave', () => {
      brush.leave();
      label.leave();
    });
    surface.addEventListener('pointerup', release);
    surface.addEventListener('pointercancel', release);
    surface.addEventListener('contextmenu', (event) => event.preventDefault());
    surface.addEventListener('dblclick', (event) => {
      if (!brush.on && !regions.cursorAt(...placeOf(event)))
        addRegion('sphere', this.pane.mmAt(...placeOf(event)));
    });
    surface.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        keepSlices();
        if (event.ctrlKey || event.metaKey) this.pane.zoomBy(Math.exp(-event.deltaY / 300), placeOf(event));
        else this.step(this.pane.frame.across, Math.sign(event.deltaY) * -this.headwards());
      },
      { passive: false },
    );
    surface.addEventListener('keydown', (event) => this.onKey(event));
    slider.addEventListener('input', () => {
      keepSlices();
      this.step(this.pane.frame.across, Number(slider.value) - this.pane.index);
    });
  }

  /** Whether the slices' numbers grow towards the patient's head, front or right. */
  private headwards(): 1 | -1 {
    const { across, name } = this.pane.frame;
    const row = { axial: 2, coronal: 1, sagittal: 0 }[name];
    return this.pane.grid.indexToMm[4 * row + across] < 0 ? -1 : 1;
  }

  private onKey(event: KeyboardEvent): void {
    const { indexToMm } = this.pane.grid;
    const along = (way: Vec3, sign: number) => {
      const { centre } = this.pane;
      const origin = toIndex(indexToMm, centre);
      const moved = toIndex(indexToMm, centre.map((x, row) => x + way[row]) as Vec3);
      const change = moved.map((x, axis) => x - origin[axis]);
      const axis = change.reduce((best, x, i) => (Math.abs(x) > Math.abs(change[best]) ? i : best), 0);
      this.step(axis, sign * Math.sign(change[axis]));
    };
    switch (event.key) {
      case 'ArrowLeft':
        along(this.pane.frame.right, -1);
        break;
      case 'ArrowRight':
        along(this.pane.frame.right, 1);
        break;
      case 'ArrowUp':
        along(this.pane.frame.up, 1);
        break;
      case 'ArrowDown':
        along(this.pane.frame.up, -1);
        break;
      case 'PageUp':
        this.step(this.pane.frame.across, this.headwards());
        break;
      case 'PageDown':
        this.step(this.pane.frame.across, -this.headwards());
        break;
      case '+':
      case '=':
        this.pane.zoomBy(1.25);
        break;
      case '-':
        this.pane.zoomBy(0.8);
        break;
      case '0':
        this.pane.reset();
        break;
      case 'Enter':
        if (!this.pane.brush.on || event.ctrlKey || event.metaKey) return;
        this.pane.brush.dab(this.pane.centre, this.pane.frame.across);
        break;
      default:
        return;
    }
    keepSlices();
    event.preventDefault();
  }
}
