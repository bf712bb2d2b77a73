import type { Frame } from '../../engine/contract';

const bytesOf = ({ values, moves }: Frame): number =>
  Object.values(values).reduce((sum, { byteLength }) => sum + byteLength, moves?.byteLength ?? 0);

/**
 * Frames of one simulation in the order of time, bounded in bytes. When they are too many every second one is
 * dropped, and so is every second that comes: the first, the newest and an even choice between them stay.
 */
export class FrameRing {
  private readonly maxBytes: number;
  private kept: { frame: Frame; number: number }[] = [];
  /** Frames whose number is a multiple of it are kept. */
  private stride = 1;
  private count = 0;
  private sum = 0;

  constructor(maxBytes: number) {
    this.maxBytes = maxBytes;
  }

  get bytes(): number {
    return this.sum;
  }

  get times(): number[] {
    return this.kept.map(({ frame }) => frame.timeMs);
  }

  /** The frames before a time, to which others may be added: whoever keeps this ring has all of its own still. */
  before(timeMs: number): FrameRing {
    const next = new FrameRing(this.maxBytes);
    next.kept = this.kept.filter(({ frame }) => frame.timeMs < timeMs);
    next.sum = next.kept.reduce((sum, { frame }) => sum + bytesOf(frame), 0);
    [next.stride, next.count] = [this.stride, this.count];
    return next;
  }

  push(frame: Frame): void {
    const newest = this.kept.at(-1);
    if (newest && newest.number % this.stride !== 0) {
      this.kept.pop();
      this.sum -= bytesOf(newest.frame);
    }
    this.kept.push({ frame, number: this.count++ });
    this.sum += bytesOf(frame);
    while (this.sum > this.maxBytes && this.kept.length > 2) this.thin();
  }

  /** The last frame that is not after a time, or the first. */
  at(timeMs: number): Frame | null {
    const found = this.kept.findLast(({ frame }) => frame.timeMs <= timeMs) ?? this.kept[0];
    return found?.frame ?? null;
  }

  private thin(): void {
    this.stride *= 2;
    const last = this.kept.length - 1;
    this.kept = this.kept.filter(({ number }, i) => number % this.stride === 0 || i === last);
    this.sum = this.kept.reduce((sum, { frame }) => sum + bytesOf(frame), 0);
  }
}
