import type { RegionShape } from '../../engine/contract';
import type { Region } from '../../geometry/regions';
import { editBody } from '../../store/case/bodies';
import { gizmoMode, type BodyName } from '../../store/view';
import { NumberField, Segments, SelectField, VectorField } from './fields';

const shapes: readonly (readonly [RegionShape, string])[] = [
  ['sphere', 'Sphere'],
  ['box', 'Box'],
  ['capsule', 'Capsule'],
];

const handles = {
  translate: 'Move',
  rotate: 'Turn',
  scale: 'Resize',
} as const;

const handlesOf = {
  sphere: ['translate', 'scale'],
  box: ['translate', 'rotate', 'scale'],
  capsule: ['translate'],
} as const;

/** What the handles in the view do to a body that is no point. */
export function BodyHandles({ shape }: { shape: RegionShape }) {
  return (
    <Segments
      label="Handle in the view"
      value={gizmoMode.value}
      options={handlesOf[shape].map((mode) => [mode, handles[mode]] as const)}
      onChange={(mode) => (gizmoMode.value = mode)}
    />
  );
}

export function BodyShape({ body, region }: { body: BodyName; region: Region }) {
  const { kind, index } = body;
  return (
    <SelectField
      label="Shape"
      value={region.shape}
      options={shapes}
      onChange={(shape) => editBody(`Shape of ${kind}`, body, { shape }, `${kind} ${index} Shape of ${kind}`)}
    />
  );
}

/** Where a body is and how large: the same numbers as its handles change. */
export function BodyFields(props: {
  body: BodyName;
  region: Region;
  /** Of its fields, in the engine's table. */
  path: string;
  owner: string;
}) {
  const { body, region, path, owner } = props;
  const { kind, index } = body;
  const set = (label: string, change: Partial<Region>) =>
    editBody(label, body, change, `${kind} ${index} ${label}`);
  return (
    <>
      {region.shape !== 'box' && (
        <NumberField
          label="Radius"
          owner={owner}
          unit="mm"
          path={`${path}.radius_mm`}
          step={1}
          value={region.radius_mm}
          onChange={(radius_mm) => set('Radius', { radius_mm })}
        />
      )}
      <VectorField
        label={region.shape === 'capsule' ? 'From' : 'Centre'}
        unit="mm"
        value={region.centre_mm}
        onChange={(centre_mm) => set(`Move ${kind}`, { centre_mm })}
      />
      {region.shape === 'capsule' && (
        <VectorField
          label="To"
          unit="mm"
          value={region.end_mm}
          onChange={(end_mm) => set(`Move ${kind} end`, { end_mm })}
        />
      )}
      {region.shape === 'box' && (
        <>
          <VectorField
            label="Half size"
            unit="mm"
            names={['1', '2', '3']}
            path={`${path}.half_size_mm`}
            value={region.half_size_mm}
            onChange={(half_size_mm) => set(`Resize ${kind}`, { half_size_mm })}
          />
          <VectorField
            label="Rotation"
            unit="°"
            names={['R', 'A', 'S']}
            path={`${path}.axes_deg`}
            value={region.axes_deg}
            onChange={(axes_deg) => set(`Turn ${kind}`, { axes_deg })}
          />
        </>
      )}
    </>
  );
}
