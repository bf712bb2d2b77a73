/** What the measures of a tetrahedron mean, drawn on one that can be flattened. */
import { useState } from 'preact/hooks';
import type { Vec3 } from '../../engine/contract';
import {
  edgesOfTet,
  flattenedTet,
  measureTet,
  type Corners,
  type Sphere,
  type TetShape,
} from '../../geometry/tet_shape';
import { Dialog } from '../controls/dialog';
import { short } from '../controls/format';

type Point = readonly [number, number];

/** Seen from above and aside, without perspective, so that spheres are circles. */
function projected([x, y, z]: Vec3): Point {
  const [turn, tilt] = [0.42, 0.38];
  const across = x * Math.cos(turn) - y * Math.sin(turn);
  const depth = x * Math.sin(turn) + y * Math.cos(turn);
  return [across, -(z * Math.cos(tilt) + depth * Math.sin(tilt))];
}

/** What a drawing points at. */
interface Marks {
  /** Edges drawn thick. */
  edges?: readonly number[];
  /** The edge whose two faces are shaded. */
  hinge?: number;
  spheres?: readonly Sphere[];
}

function Drawing({ corners, marks }: { corners: Corners; marks: Marks }) {
  const at = corners.map(projected);
  const path = (ids: readonly number[]) => ids.map((id) => at[id].join(',')).join(' ');
  const faces =
    marks.hinge === undefined
      ? []
      : edgesOfTet[5 - marks.hinge].map((id) => [...edgesOfTet[marks.hinge!], id]);
  return (
    <svg class="tet-drawing" viewBox="-1.35 -1.3 2.7 2.6" aria-hidden="true">
      {marks.spheres?.map(({ centre, radius }) => {
        const [x, y] = projected(centre);
        return <circle key={radius} cx={x} cy={y} r={radius} />;
      })}
      {faces.map((face) => (
        <polygon key={face.join()} points={path(face)} />
      ))}
      {edgesOfTet.map((edge, e) => (
        <polyline
          key={e}
          points={path(edge)}
          class={marks.edges?.includes(e) || marks.hinge === e ? 'marked' : undefined}
        />
      ))}
    </svg>
  );
}

interface Measure {
  name: string;
  means: string;
  good: string;
  value(shape: TetShape): string;
  marks(shape: TetShape): Marks;
}

const smallest = (values: readonly number[]) => values.indexOf(Math.min(...values));
const largest = (values: readonly number[]) => values.indexOf(Math.max(...values));
const degrees = (value: number) => `${value.toFixed(1)}°`;

const measures: readonly Measure[] = [
  {
    name: 'Smallest dihedral angle',
    means:
      'The sharpest angle between two faces. Small ones make the equations of a simulation ill-conditioned.',
    good: 'at most 70.5°; at least 10° is wanted',
    value: ({ dihedral }) => degrees(Math.min(...dihedral)),
    marks: ({ dihedral }) => ({ hinge: smallest(dihedral) }),
  },
  {
    name: 'Largest dihedral angle',
    means: 'The bluntest angle between two faces. Near 180° gradients on the element are wrong.',
    good: 'at least 70.5°; below 165° is good',
    value: ({ dihedral }) => degrees(Math.max(...dihedral)),
    marks: ({ dihedral }) => ({ hinge: largest(dihedral) }),
  },
  {
    name: 'Radius ratio',
    means: 'Three times the inscribed sphere’s radius over that of the sphere through the corners.',
    good: '1 is regular, 0 is flat',
    value: ({ radiusRatio }) => short(radiusRatio),
    marks: ({ inscribed, circumscribed }) => ({ spheres: [circumscribed, inscribed] }),
  },
  {
    name: 'Mean ratio',
    means: 'Its volume against the mean of its squared edges: 12 (3V)^(2/3) over their sum.',
    good: '1 is regular, 0 is flat',
    value: ({ meanRatio }) => short(meanRatio),
    marks: () => ({ edges: [0, 1, 2, 3, 4, 5] }),
  },
  {
    name: 'Aspect ratio',
    means: 'The longest edge over the inscribed sphere’s radius, divided by what the regular one has.',
    good: '1 is regular, larger is flatter',
    value: ({ aspectRatio }) => short(aspectRatio),
    marks: ({ edges, inscribed }) => ({ edges: [largest(edges)], spheres: [inscribed] }),
  },
  {
    name: 'Scaled Jacobian',
    means: 'Six volumes over the largest product of the three edges at a corner, times √2.',
    good: '1 is regular, 0 is flat, negative is inverted',
    value: ({ scaledJacobian }) => short(scaledJacobian),
    marks: () => ({ edges: [0, 1, 2] }),
  },
];

const others: readonly [string, string][] = [
  ['Edge length', 'Of every edge, mm. The target is what the sizes of the case ask for at its middle.'],
  [
    'Size ratio',
    'Edge length over target. No mesh meets its target everywhere: good ones keep nearly all edges between 0.71 and 1.41.',
  ],
  [
    'Aspect ratio of surface triangles',
    'The longest edge over the inscribed circle’s radius, divided by what the equilateral one has: 1 is best.',
  ],
];

export function GlossaryDialog({ close }: { close(): void }) {
  const [flatness, setFlatness] = useState(0.55);
  const corners = flattenedTet(flatness);
  const shape = measureTet(corners);
  return (
    <Dialog title="What the measures mean" onClose={close}>
      <label class="glossary-flatten">
        <span>Flatten it</span>
        <input
          type="range"
          min={0}
          max={0.97}
          step={0.01}
          value={flatness}
          onInput={(event) => setFlatness(event.currentTarget.valueAsNumber)}
        />
      </label>
      <ul class="glossary">
        {measures.map(({ name, means, good, value, marks }) => (
          <li key={name}>
            <Drawing corners={corners} marks={marks(shape)} />
            <div>
              <strong>{name}</strong> <output>{value(shape)}</output>
              <p>{means}</p>
              <p class="muted">{good}</p>
            </div>
          </li>
        ))}
      </ul>
      <dl class="glossary-others">
        {others.map(([name, means]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{means}</dd>
          </div>
        ))}
      </dl>
    </Dialog>
  );
}
