/** Files beside the volume that sizes come from: masks, and images of edge lengths. */
import { computed, signal } from '@preact/signals';
import type { FileSource, SideKind, VolumeFile } from '../../engine/contract';
import { engine } from '../run/engine';
import { recipe } from './recipe';

/** A file that is at hand, with the digest of its content. */
export interface SideFile {
  kind: SideKind;
  file: VolumeFile;
  digest: string;
}

export interface AwaitedSide extends FileSource {
  kind: SideKind;
}

/** Digests of the files at hand. */
const held = signal<ReadonlyMap<string, string>>(new Map());
const keyOf = (kind: SideKind, name: string) => `${kind} ${name}`;

/** Files that the recipe names and that have to be dropped in. */
export const awaitedSides = computed<AwaitedSide[]>(() => {
  const { masks = [], images = [] } = recipe.value?.sizing ?? {};
  const all: AwaitedSide[] = [
    ...masks.map(({ name, sha256 }) => ({ kind: 'mask' as const, name, sha256 })),
    ...images.map(({ name, sha256 }) => ({ kind: 'image' as const, name, sha256 })),
  ];
  return all.filter(({ kind, name, sha256 }) => {
    const digest = held.value.get(keyOf(kind, name));
    return digest === undefined || (sha256 !== '' && sha256 !== digest);
  });
});

/** Takes a file whose content is known: one of an earlier session, or one that the page has made. */
export function holdSide({ kind, file, digest }: SideFile): void {
  engine.files.keepSide(kind, file, digest);
  held.value = new Map(held.value).set(keyOf(kind, file.name), digest);
}

/** Those of the recipe that are at hand. */
export function heldSides(): SideFile[] {
  const { masks = [], images = [] } = recipe.peek()?.sizing ?? {};
  const find = (kind: SideKind, { name }: FileSource): SideFile[] => {
    const file = engine.files.side(kind, name);
    const digest = held.peek().get(keyOf(kind, name));
    return file && digest !== undefined ? [{ kind, file, digest }] : [];
  };
  return [...masks.flatMap((one) => find('mask', one)), ...images.flatMap((one) => find('image', one))];
}

export function forgetSides(): void {
  engine.files.forgetSides();
  held.value = new Map();
}
