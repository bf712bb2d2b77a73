import { useRef } from 'preact/hooks';
import type { PhantomKind, PhantomParams, Recipe, Vec3 } from '../engine/contract';
import { editPhantom, openFiles, openPhantom, openSample } from '../store/actions';
import { previewSoon } from '../store/runs';
import { volume } from '../store/input';
import { CheckField, NumberField, SelectField, VectorField } from './fields';
import { short } from './format';
import { Icon } from './icons';

const bodies: readonly (readonly [PhantomKind, string])[] = [
  ['biventricle', 'Heart (two ventricles)'],
  ['sphere', 'Sphere'],
  ['shell', 'Shell'],
  ['torus', 'Torus'],
  ['slab', 'Slab'],
  ['nested_boxes', 'Nested boxes'],
  ['branching_tube', 'Branching tube'],
];

export function FileButton({ label, primary }: { label: string; primary?: boolean }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button
        type="button"
        class={primary ? 'button primary' : 'button'}
        onClick={() => input.current?.click()}
      >
        <Icon name="file" /> {label}
      </button>
      <input
        ref={input}
        type="file"
        multiple
        hidden
        aria-hidden="true"
        tabIndex={-1}
        data-testid="file-input"
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = '';
          void openFiles(files);
        }}
      />
    </>
  );
}

export function SourceSection({ current }: { current: Recipe }) {
  const { phantom, file } = current.source;
  const known = volume.value;
  const interpolated = known?.prepared && known.prepared.size.join() !== known.size.join();
  return (
    <section class="section">
      <h2>Volume</h2>
      <div class="source-buttons">
        <FileButton label="Open file…" />
        <button type="button" class="button" onClick={() => void openSample()}>
          Sample heart
        </button>
      </div>
      {file && (
        <p class="source-name" title={file.name}>
          <Icon name="file" /> {file.name}
        </p>
      )}
      {phantom && <PhantomFields phantom={phantom} />}
      {known && (
        <p class="facts">
          {known.size.join(' × ')} voxels of {known.spacing_mm.map(short).join(' × ')} mm
          {interpolated && `, slices interpolated to ${known.prepared?.spacing_mm.map(short).join(' × ')} mm`}
        </p>
      )}
    </section>
  );
}

function PhantomFields({ phantom }: { phantom: PhantomParams }) {
  const edit = (label: string, change: Partial<PhantomParams>) => {
    editPhantom(label, change);
    previewSoon();
  };
  const number = (label: string, key: keyof PhantomParams, unit?: string) => (
    <NumberField
      label={label}
      unit={unit}
      path={`source.phantom.${key}`}
      value={phantom[key] as number}
      onChange={(value) => edit(label, { [key]: value })}
    />
  );
  const heart = phantom.kind === 'biventricle';
  const round = phantom.kind !== 'slab' && !heart;
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
        {heart && number('Scale', 'scale')}
        {heart && number('Roughness', 'roughness_mm', 'mm')}
        {heart && number('Seed', 'seed')}
        {round && number('Radius', 'radius_mm', 'mm')}
        {(phantom.kind === 'shell' || phantom.kind === 'torus') &&
          number('Inner radius', 'inner_radius_mm', 'mm')}
        {phantom.kind === 'slab' && number('Thickness', 'thickness_mm', 'mm')}
        {heart && (
          <CheckField
            label="Scar with isthmus"
            checked={phantom.scar}
            onChange={(scar) => edit('Scar', { scar })}
          />
        )}
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
