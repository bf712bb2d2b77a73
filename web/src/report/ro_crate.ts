/**
 * A zip as a research object: `ro-crate-metadata.json`, which says what the files are and how they were made. RO-Crate
 * 1.1 (doi 10.5281/zenodo.4541002), and of its profiles Process Run Crate 0.5.
 */
import { promisedStages, type Report } from '../engine/contract';

export interface CrateFile {
  path: string;
  description: string;
  /** Media type. */
  format: string;
  bytes: Uint8Array<ArrayBuffer>;
  /** What the run was made from; else what it has made. */
  isInput?: boolean;
}

type Entity = { '@id': string; '@type': string | string[] } & Record<string, unknown>;

const profile = 'https://w3id.org/ro/wfrun/process/0.5';
const agpl = 'https://spdx.org/licenses/AGPL-3.0-or-later';

export const crateFileName = 'ro-crate-metadata.json';

const mediaTypes: Record<string, string> = {
  json: 'application/json',
  html: 'text/html',
  vtu: 'application/vnd.kitware.vtu+xml',
  inp: 'text/plain',
  feb: 'application/xml',
  nii: 'application/x-nifti',
};

/** The media type of a file, by its ending. */
export const mediaTypeOf = (name: string): string =>
  mediaTypes[name.slice(name.lastIndexOf('.') + 1)] ?? 'application/octet-stream';

async function sha256Of(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
  return [...digest].map((byte) => byte.toString(16).padStart(2, '0')).join('');
}

/** The description of these files, as JSON-LD; `at`: when the run was made. */
export async function roCrate(
  found: Report,
  files: readonly CrateFile[],
  context: { title: string; link: string; at: Date },
): Promise<object> {
  const { title, link, at } = context;
  const entries: Entity[] = await Promise.all(
    files.map(async ({ path, description, format, bytes }) => ({
      '@id': path,
      '@type': 'File',
      name: path,
      description,
      encodingFormat: format,
      contentSize: String(bytes.length),
      // Absent where the page is not served securely: browsers then have no digests.
      ...(globalThis.crypto?.subtle && { sha256: await sha256Of(bytes) }),
    })),
  );
  const ids = (all: readonly Entity[]) => all.map((one) => ({ '@id': one['@id'] }));
  const digest = (id: string, name: string, value: string): Entity => ({
    '@id': id,
    '@type': 'PropertyValue',
    propertyID: 'sha256',
    name,
    value,
  });
  const volume: Entity = {
    '@id': '#volume',
    '@type': 'Dataset',
    name: found.source.name,
    description:
      'The label volume that was meshed. It is not among the files; its digest is of the decoded voxels and their affine.',
    identifier: { '@id': '#volume-digest' },
  };
  const simulated = found.stages.filter(({ name }) => (promisedStages as readonly string[]).includes(name));
  const digests = [
    digest('#volume-digest', 'Digest of the volume', found.source.digest),
    digest('#mesh-digest', 'Digest of the mesh', found.digest),
    ...simulated.map(({ name, digest: value }) => digest(`#${name}-digest`, `Digest of ${name}`, value)),
  ];
  const engine: Entity = {
    '@id': '#engine',
    '@type': 'SoftwareApplication',
    name: 'voxtet',
    softwareVersion: found.engine,
    description: `Segmented volumes to simulation-ready tetrahedra.${found.physics ? ` Physics ${found.physics}.` : ''}`,
    license: { '@id': agpl },
  };
  const [inputs, made] = [true, false].map((input) =>
    ids(entries.filter((_, i) => (files[i].isInput ?? false) === input)),
  );
  const run: Entity = {
    '@id': '#run',
    '@type': 'CreateAction',
    name: `${title} meshed by voxtet ${found.engine}`,
    instrument: { '@id': '#engine' },
    object: [...inputs, { '@id': '#volume' }],
    result: made,
    endTime: at.toISOString(),
  };
  return {
    '@context': 'https://w3id.org/ro/crate/1.1/context',
    '@graph': [
      {
        '@id': crateFileName,
        '@type': 'CreativeWork',
        about: { '@id': './' },
        conformsTo: { '@id': 'https://w3id.org/ro/crate/1.1' },
      },
      {
        '@id': './',
        '@type': 'Dataset',
        name: `${title}: a tetrahedral mesh with its evidence`,
        description: `${found.tets} tetrahedra of ${found.source.name}, with the case that makes them again. Open it: ${link}`,
        datePublished: at.toISOString(),
        license: 'As the volume that it was made from.',
        conformsTo: { '@id': profile },
        hasPart: ids(entries),
        mentions: [{ '@id': '#run' }],
        identifier: ids(digests),
      },
      { '@id': profile, '@type': 'CreativeWork', name: 'Process Run Crate', version: '0.5' },
      { '@id': agpl, '@type': 'CreativeWork', name: 'GNU Affero General Public License v3.0 or later' },
      run,
      engine,
      volume,
      ...digests,
      ...entries,
    ],
  };
}
