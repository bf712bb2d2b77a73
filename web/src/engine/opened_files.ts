import type { Recipe, SideKind, VolumeFile } from './contract';
import { recipeDefaults } from './generated';
import type { Side } from './generation';

/** How a file is read, as the engine is told: the source of a recipe without what is read. */
export const readOptions = (source: Partial<Recipe['source']>): string =>
  JSON.stringify({
    ...recipeDefaults.source,
    ...source,
    phantom: undefined,
    inline: undefined,
    file: undefined,
  });

export const sideKey = (kind: SideKind, name: string): string => `${kind} ${name}`;

/** The bytes of the files that were opened, so that every new worker can be given them. */
export class OpenedFiles {
  private readonly volumes = new Map<string, VolumeFile>();
  private readonly sides = new Map<string, Side>();
  /** Those that the last mesh was made from, where later ones of the same names have come. */
  private meshedSides: ReadonlyMap<string, Side> = new Map();

  /** A label volume by its digest. */
  volume(digest: string): VolumeFile | undefined {
    return this.volumes.get(digest);
  }

  /** Takes a volume, also one that an earlier session opened: it is read when a case needs it. */
  keepVolume(digest: string, file: VolumeFile): void {
    this.volumes.set(digest, file);
  }

  /** Forgets every volume but this one. */
  forgetVolumes(except = ''): void {
    for (const digest of this.volumes.keys()) if (digest !== except) this.volumes.delete(digest);
  }

  /** The file of a mask or an image of sizes. */
  side(kind: SideKind, name: string): VolumeFile | undefined {
    return this.sides.get(sideKey(kind, name))?.file;
  }

  /** Takes such a file, read or unread: one of an earlier session, or one that the page itself has made. */
  keepSide(kind: SideKind, file: VolumeFile, digest: string): Side {
    const side = { file, digest };
    this.sides.set(sideKey(kind, file.name), side);
    return side;
  }

  forgetSides(): void {
    this.sides.clear();
    this.meshedSides = new Map();
  }

  /** A mesh has been made from these. */
  meshedFrom(sides: ReadonlyMap<string, Side>): void {
    this.meshedSides = new Map(sides);
  }

  /** The file that a recipe means: that of the mesh where it has the digest, else the latest of its name. */
  sideFor(kind: SideKind, name: string, digest: string): Side | undefined {
    const meshed = this.meshedSides.get(sideKey(kind, name));
    return meshed?.digest === digest ? meshed : this.sides.get(sideKey(kind, name));
  }
}
