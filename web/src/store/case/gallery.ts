/** Cases to begin with. Their pictures, gallery/NAME.png, are made by `npm run screenshots`. */
export interface Example {
  name: string;
  title: string;
  /** What there is to see in it. */
  text: string;
  recipe: Record<string, unknown>;
}

const phantom = (params: Record<string, unknown>, edge_mm: number): Record<string, unknown> => ({
  source: { phantom: params },
  sizing: { edge_mm },
});

export const gallery: readonly Example[] = [
  {
    name: 'heart-scar',
    title: 'Heart with a scar',
    text: 'Two ventricles; finer in scar and border zone',
    recipe: {
      source: { phantom: { kind: 'biventricle', scar: true, spacing_mm: [2, 2, 2] } },
      labels: [1, 2, 5, 6],
      sizing: {
        edge_mm: 4,
        labels: [
          { label: 5, edge_mm: 2 },
          { label: 6, edge_mm: 2.5 },
        ],
      },
    },
  },
  {
    name: 'heart-pools',
    title: 'Heart with blood',
    text: 'Walls and blood pools, conforming',
    recipe: phantom({ kind: 'biventricle', spacing_mm: [2, 2, 2] }, 4),
  },
  {
    name: 'branching-tube',
    title: 'Branching tube',
    text: 'A vessel that forks',
    recipe: phantom({ kind: 'branching_tube', spacing_mm: [1.5, 1.5, 1.5] }, 3),
  },
  {
    name: 'nested-boxes',
    title: 'Nested boxes',
    text: 'Flat walls, sharp edges, labels inside labels',
    recipe: phantom({ kind: 'nested_boxes', spacing_mm: [1.5, 1.5, 1.5] }, 3),
  },
  {
    name: 'torus',
    title: 'Torus',
    text: 'A tunnel that has to stay one',
    recipe: phantom({ kind: 'torus', spacing_mm: [1.5, 1.5, 1.5] }, 3),
  },
  {
    name: 'oblique-shell',
    title: 'Oblique shell',
    text: 'A thin wall in a turned, mirrored image',
    recipe: phantom(
      { kind: 'shell', spacing_mm: [1.5, 1.5, 1.5], rotation_deg: [20, 30, 10], mirrored: true },
      3,
    ),
  },
];
