import type { Frame } from '../../engine/contract';

const bytesOf = (frame: Frame): number =>
  Object.values(frame.values).reduce((sum, { byteLength }) => sum + byteLength, 0);

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

  push(frame: Frame): void {
    const newest = this.kept.at(-1);
    if (newest && newest.number % this.stride !== 0) this.keep(this.kept.slice(0, -1));
    this.keep([...this.kept, { frame, number: this.count++ }]);
    while (this.sum > this.maxBytes && this.kept.length > 2) this.thin();
  }

  /** The last frame that is not after a time, or the first. */
  at(timeMs: number): Frame | null {
    let found = this.kept[0];
    for (const one of this.kept) if (one.frame.timeMs <= timeMs) found = one;
    return found?.frame ?? null;
  }

  private thin(): void {
    this.stride *= 2;
    const last = this.kept.length - 1;
    this.keep(this.kept.filter(({ number }, i) => number % this.stride === 0 || i === last));
  }

  private keep(kept: typeof this.kept): void {
    this.kept = kept;
    this.sum = kept.reduce((sum, { frame }) => sum + bytesOf(frame), 0);
  }
}
