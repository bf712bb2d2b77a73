/** The lessons that ship with the page, each opened by `?lesson=NAME`. Their texts are fetched when they are opened. */
interface Shipped {
  name: string;
  title: string;
  /** What there is to learn. */
  text: string;
  load(): Promise<unknown>;
}

const json = (module: Promise<{ default: unknown }>) => module.then((part) => part.default);

export const shipped: readonly Shipped[] = [
  {
    name: 'surface',
    title: 'From voxels to a smooth surface',
    text: 'Why the staircase has too much area, and what smoothing may not do',
    load: () => json(import('./shipped/surface.json')),
  },
  {
    name: 'sizing',
    title: 'What a sizing field is',
    text: 'An edge length for every place, and how fast it may change',
    load: () => json(import('./shipped/sizing.json')),
  },
  {
    name: 'slivers',
    title: 'Why slivers hurt',
    text: 'Flat elements and the condition of a stiffness matrix',
    load: () => json(import('./shipped/slivers.json')),
  },
  {
    name: 'topology',
    title: 'Many labels, and their topology',
    text: 'Cavities, tunnels and neighbours that a mesh has to keep',
    load: () => json(import('./shipped/topology.json')),
  },
  {
    name: 'layers',
    title: 'Layers through a wall',
    text: 'How many elements lie across a thin wall',
    load: () => json(import('./shipped/layers.json')),
  },
  {
    name: 'adaptive',
    title: 'Adaptive against uniform',
    text: 'The same size where it counts, with a fraction of the elements',
    load: () => json(import('./shipped/adaptive.json')),
  },
  {
    name: 'wave',
    title: 'How a wave goes around a scar',
    text: 'Excitation of a heart, and the detour that a scar forces on it',
    load: () => json(import('./shipped/wave.json')),
  },
  {
    name: 'beat',
    title: 'How many layers does a beating heart need?',
    text: 'Elements that lock, and what a layer of them is worth',
    load: () => json(import('./shipped/beat.json')),
  },
];
