type Place = readonly [number, number];

interface Moved {
  zoomBy(factor: number, about: [number, number]): void;
  shiftBy(px: number, py: number): void;
}

/** Two fingers on a slice: what lies under them stays there, so it is zoomed and shifted. */
export class SliceTouch {
  private readonly pane: Moved;
  private readonly fingers = new Map<number, Place>();
  /** From a second finger until the last is lifted: a finger that is left steers nothing. */
  pinching = false;

  constructor(pane: Moved) {
    this.pane = pane;
  }

  /** Whether a second finger has come to the first. */
  down(event: PointerEvent, at: Place): boolean {
    if (event.pointerType !== 'touch') return false;
    this.fingers.set(event.pointerId, at);
    if (this.fingers.size !== 2 || this.pinching) return false;
    this.pinching = true;
    return true;
  }

  /** Whether the move was that of a pinch. */
  move(event: PointerEvent, at: Place): boolean {
    if (!this.fingers.has(event.pointerId)) return false;
    const before = this.span();
    this.fingers.set(event.pointerId, at);
    const after = this.span();
    if (this.pinching && before && after) {
      this.pane.shiftBy(after.middle[0] - before.middle[0], after.middle[1] - before.middle[1]);
      if (before.length > 0 && after.length > 0) this.pane.zoomBy(after.length / before.length, after.middle);
    }
    return this.pinching;
  }

  up(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    if (this.fingers.size === 0) this.pinching = false;
  }

  private span(): { middle: [number, number]; length: number } | null {
    const [a, b] = this.fingers.values();
    if (!a || !b) return null;
    return { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], length: Math.hypot(a[0] - b[0], a[1] - b[1]) };
  }
}
