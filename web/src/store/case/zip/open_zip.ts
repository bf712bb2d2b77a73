/** Zips that hold a case with its files. */
import type { FileSource, SideKind, VolumeFile } from '../../../engine/contract';
import { parseCase } from '../../../link/codec';
import { tellError } from '../../run/engine';
import { offerCase, offered } from '../open_case';
import type { SideFile } from '../side_files';
import { unpackZip } from './zip';

/** What the header of a file in a zip may name. */
function siblingsIn(entries: VolumeFile['siblings'], name: string): VolumeFile['siblings'] {
  if (!/\.(nhdr|mhd|hdr)$/i.test(name)) return {};
  return Object.fromEntries(
    Object.entries(entries).filter(([other]) => /\.(z?raw|img|bin|dat)(\.gz)?$/i.test(other)),
  );
}

/** A zip that was exported here: its case, with the masks and images in it. */
export async function openZip(file: File): Promise<void> {
  try {
    const entries = await unpackZip(new Uint8Array(await file.arrayBuffer()));
    const name = Object.keys(entries).find((one) => one.endsWith('.case.json'));
    if (!name) throw new Error(`${file.name} holds no case: no file in it ends in .case.json.`);
    const value = parseCase(new TextDecoder().decode(entries[name]));
    await offerCase(value);
    const { masks, images } = offered.value?.recipe.sizing ?? { masks: [], images: [] };
    const sidesOf = (kind: SideKind, files: FileSource[]) =>
      files.flatMap(({ name, sha256 }): SideFile[] =>
        entries[name]
          ? [
              {
                kind,
                file: { name, bytes: entries[name], siblings: siblingsIn(entries, name) },
                digest: sha256,
              },
            ]
          : [],
      );
    // The engine holds their content against the digests of the case.
    const sides = [...sidesOf('mask', masks), ...sidesOf('image', images)];
    if (offered.value) offered.value = { ...offered.value, sides };
  } catch (error) {
    tellError(error);
  }
}
