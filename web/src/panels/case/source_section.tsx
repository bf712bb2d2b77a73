import type { PhantomKind, PhantomParams, Recipe, Vec3, VolumeSummary } from '../../engine/contract';
import { obliqueness, orientationLetters } from '../../geometry/orientation';
import { editPhantom, openPhantom } from '../../store/case/open_case';
import { otherWarnings } from '../../store/case/clean';
import { openFiles } from '../../store/case/open_files';
import { previewSoon } from '../../store/run/run_stages';
import { volume } from '../../store/case/input';
import { dialogShown } from '../controls/dialog_shown';
import { fetched } from '../controls/fetched';
import { fieldUnit } from '../controls/field_words';
import { CheckField, fieldOf, NumberField, SelectField, VectorField } from '../controls/fields';
import { FileInput } from '../controls/file_input';
import { short, whole } from '../controls/format';
import { Icon } from '../controls/icons';

const bodies: readonly (readonly [PhantomKind, string])[] = [
  ['biventricle', 'Heart (two ventricles)'],
  ['sphere', 'Sphere'],
  ['shell', 'Shell'],
  ['torus', 'Torus'],
  ['slab', 'Slab'],
  ['nested_boxes', 'Nested boxes'],
  ['branching_tube', 'Branching tube'],
  ['atlas', 'Atlas of many regions'],
];

type NumberKey = {
  [K in keyof PhantomParams]: PhantomParams[K] extends number ? K : never;
}[keyof PhantomParams];
const heartFields: readonly (readonly [NumberKey, string])[] = [
  ['wall_scale', 'Thickness of the LV wall'],
  ['length_scale', 'Length of the ventricles'],
  ['rv_dilation', 'Depth of the RV'],
  ['rv_wall_mm', 'Thickness of the RV wall'],
];
const scarFields: readonly (readonly [NumberKey, string])[] = [
  ['scar_angle_deg', 'Scar around the LV'],
  ['scar_height_mm', 'Scar towards the base'],
  ['scar_arc_mm', 'Width of the scar'],
  ['scar_length_mm', 'Length of the scar'],
  ['scar_depth', 'Depth of the scar'],
  ['border_mm', 'Width of the border zone'],
  ['isthmus_mm', 'Width of the isthmus'],
];

export function FileButton({ label, primary }: { label: string; primary?: boolean }) {
  return (
    <FileInput
      class={primary ? 'button primary' : 'button'}
      testId="file-input"
      onFiles={(files) => void openFiles(files)}
    >
      <Icon name="file" /> {label}
    </FileInput>
  );
}

/** What was read, so that a wrong spacing or a turned image is seen before it is meshed. */
function ReadFacts({ known }: { known: VolumeSummary }) {
  const { size, spacing_mm, index_to_mm, prepared, mesh } = known;
  const turned = obliqueness(index_to_mm);
  const product = (numbers: readonly (number | string)[]) => numbers.join(' × ');
  const ofMesh: [string, string, string?][] = mesh
    ? [
        ['Points', whole(mesh.points)],
        ['Tetrahedra', whole(mesh.tets)],
        ['Fibres', mesh.fibres ? 'read' : 'none'],
      ]
    : [];
  const rows: [string, string, string?][] = [
    ...ofMesh,
    ['Voxels', product(size)],
    ['Spacing', `${product(spacing_mm.map(short))} mm`],
    ['Extent', `${product(size.map((n, axis) => short(n * spacing_mm[axis])))} mm`],
    [
      'Orientation',
      `${orientationLetters(index_to_mm)}${turned > 0.5 ? `, oblique by ${short(turned)}°` : ''}`,
      'Where each voxel axis leads: right or left, anterior or posterior, superior or inferior',
    ],
  ];
  // The grid may also be larger, where the image cuts a body off, and its axes in another order.
  const voxelMm3 = ([x, y, z]: Vec3) => x * y * z;
  if (prepared && Math.abs(voxelMm3(prepared.spacing_mm) / voxelMm3(spacing_mm) - 1) > 1e-3)
    rows.push(['Interpolated to', `${product(prepared.spacing_mm.map(short))} mm`]);
  return (
    <dl class="read-facts">
      {rows.map(([name, value, title]) => (
        <div key={name} title={title}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

const Flaws = fetched(() => import('./flaws').then((part) => part.Flaws));

export function SourceSection({ current }: { current: Recipe }) {
  const { phantom, inline, file } = current.source;
  const known = volume.value;
  return (
    <section class="section">
      <h2>{known?.mesh ? 'Mesh' : 'Volume'}</h2>
      <div class="source-buttons">
        <FileButton label="Open file…" />
        <button type="button" class="button" onClick={() => (dialogShown.value = 'examples')}>
          Examples…
        </button>
      </div>
      {file && (
        <p class="source-name" title={file.name}>
          <Icon name="file" /> {file.name}
          {known && !known.mesh && (
            <button
              type="button"
              class="link-button"
              title="Unit, background, frame, and which segment wins where some overlap"
              onClick={() => (dialogShown.value = 'reading')}
            >
              How it is read…
            </button>
          )}
        </p>
      )}
      {inline && (
        <p class="source-name" title={`${inline.name}, within the case`}>
          <Icon name="file" /> {inline.name}
        </p>
      )}
      {phantom && <PhantomFields phantom={phantom} />}
      {known && <ReadFacts known={known} />}
      {known &&
        otherWarnings(known).map((warning) => (
          <p key={warning} class="stale">
            {warning}
          </p>
        ))}
      {known?.flaws && known.flaws.length > 0 && <Flaws flaws={known.flaws} />}
    </section>
  );
}

function PhantomFields({ phantom }: { phantom: PhantomParams }) {
  const edit = (label: string, change: Partial<PhantomParams>) => {
    editPhantom(label, change);
    previewSoon();
  };
  const number = (key: NumberKey, label: string) => {
    const path = `source.phantom.${key}`;
    return (
      <NumberField
        key={key}
        label={label}
        unit={fieldUnit(path, fieldOf(path)?.unit)}
        path={path}
        value={phantom[key]}
        onChange={(value) => edit(label, { [key]: value })}
      />
    );
  };
  const heart = phantom.kind === 'biventricle';
  const atlas = phantom.kind === 'atlas';
  const round = phantom.kind !== 'slab' && !heart && !atlas;
  return (
    <>
      <SelectField
        label="Generated body"
        value={phantom.kind}
        options={bodies}
        onChange={(kind) => void openPhantom({ kind, spacing_mm: phantom.spacing_mm })}
      />
      <NumberField
        label="Voxel size"
        unit="mm"
        path="source.phantom.spacing_mm"
        value={phantom.spacing_mm[0]}
        onChange={(value) => edit('Voxel size', { spacing_mm: [value, value, value] as Vec3 })}
      />
      <details class="more">
        <summary>Shape of the body</summary>
        {(heart || atlas) && number('scale', 'Scale')}
        {heart && heartFields.map(([key, label]) => number(key, label))}
        {heart && number('roughness_mm', 'Roughness')}
        {atlas && number('regions', 'Regions')}
        {(heart || atlas) && number('seed', 'Seed')}
        {round && number('radius_mm', 'Radius')}
        {(phantom.kind === 'shell' || phantom.kind === 'torus') && number('inner_radius_mm', 'Inner radius')}
        {phantom.kind === 'slab' && number('thickness_mm', 'Thickness')}
        {heart && (
          <CheckField
            label="Scar with isthmus"
            checked={phantom.scar}
            onChange={(scar) => edit('Scar', { scar })}
          />
        )}
        {heart && phantom.scar && scarFields.map(([key, label]) => number(key, label))}
        {heart && (
          <CheckField
            label="Blood pools"
            checked={phantom.blood_pools}
            onChange={(blood_pools) => edit('Blood pools', { blood_pools })}
          />
        )}
        <CheckField
          label="Mirrored image axis"
          checked={phantom.mirrored}
          onChange={(mirrored) => edit('Mirrored', { mirrored })}
        />
        <VectorField
          label="Image rotation"
          unit="°"
          names={['x', 'y', 'z']}
          path="source.phantom.rotation_deg"
          value={phantom.rotation_deg}
          onChange={(rotation_deg) => edit('Image rotation', { rotation_deg })}
        />
      </details>
    </>
  );
}
