import { signal } from '@preact/signals';
import type { VolumeSummary } from '../engine/contract';

/** The label volume that the case stands on, once it has been read or generated. */
export const volume = signal<VolumeSummary | null>(null);

/** A file that the recipe needs and that has not been dropped in yet. */
export const awaitedFile = signal<{ name: string; sha256: string } | null>(null);
