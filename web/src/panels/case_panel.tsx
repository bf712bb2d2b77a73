import { useRef } from 'preact/hooks';
import type { PhantomKind, PhantomParams, Recipe, Vec3 } from '../engine/contract';
import { editPhantom, openFiles, openPhantom, openSample, previewSoon } from '../store/actions';
import { awaitedFile, volume } from '../store/input';
import { groupsOf, mergesAll } from '../store/labels';
import { editRecipe, recipe } from '../store/recipe';
import { activity } from '../store/run';
import { colourOf, hiddenLabels, ownColours } from '../store/view';
import { CheckField, Field, fieldOf, NumberInput, SelectField, VectorField } from './fields';
import { short, whole } from './format';
import { Icon } from './icons';
import { RegionList } from './region_list';

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

function SourceSection({ current }: { current: Recipe }) {
  const { phantom, file } = current.source;
  const known = volume.value;
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
    <Field label={label} unit={unit}>
      <NumberInput
        label={label}
        path={`source.phantom.${key}`}
        value={phantom[key] as number}
        onChange={(value) => value !== null && edit(label, { [key]: value })}
      />
    </Field>
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
      <Field label="Voxel size" unit="mm">
        <NumberInput
          label="Voxel size"
          path="source.phantom.spacing_mm"
          value={phantom.spacing_mm[0]}
          onChange={(value) =>
            value !== null && edit('Voxel size', { spacing_mm: [value, value, value] as Vec3 })
          }
        />
      </Field>
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

function LabelTable({ current }: { current: Recipe }) {
  const known = volume.value;
  if (!known) return null;
  const chosen = new Set(
    current.labels.length > 0 ? current.labels : known.labels.map((entry) => entry.label),
  );
  const wished = new Map(current.sizing.labels.map((entry) => [entry.label, entry.edge_mm]));
  const colour = colourOf.value;
  const toggleMesh = (label: number) => {
    editRecipe(chosen.has(label) ? 'Leave label out' : 'Mesh label', (draft) => {
      const next = known.labels
        .map((entry) => entry.label)
        .filter((one) => (one === label ? !chosen.has(one) : chosen.has(one)));
      draft.labels = next.length === known.labels.length ? [] : next;
      draft.merge = groupsOf(draft.merge, [...chosen], next);
    });
    previewSoon();
  };
  const setEdge = (label: number, edge: number | null) =>
    editRecipe(
      'Edge length of label',
      (draft) => {
        const others = draft.sizing.labels.filter((entry) => entry.label !== label);
        if (edge !== null) others.push({ label, edge_mm: edge });
        draft.sizing.labels = others.sort((a, b) => a.label - b.label);
      },
      `label edge ${label}`,
    );
  const toggleSeen = (label: number) => {
    const next = new Set(hiddenLabels.value);
    if (!next.delete(label)) next.add(label);
    hiddenLabels.value = next;
  };
  const last = chosen.size === 1;
  return (
    <section class="section">
      <h2>Labels</h2>
      <div class="label-scroll"><table class="labels">
        <thead>
          <tr>
            <th scope="col">
              <span class="sr">Colour</span>
            </th>
            <th scope="col">Label</th>
            <th scope="col" class="num">
              Voxels
            </th>
            <th scope="col">Mesh</th>
            <th scope="col">Edge mm</th>
            <th scope="col">
              <span class="sr">Show</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {known.labels.map(({ label, name, voxels }) => {
            const meshed = chosen.has(label);
            const text = name || `Label ${label}`;
            const hidden = hiddenLabels.value.has(label);
            return (
              <tr key={label} class={meshed ? '' : 'off'}>
                <td>
                  <input
                    type="color"
                    class="swatch"
                    aria-label={`Colour of ${text}`}
                    value={colour(label)}
                    onInput={(event) =>
                      (ownColours.value = { ...ownColours.value, [label]: event.currentTarget.value })
                    }
                  />
                </td>
                <td class="label-name" title={`${text} (${label})`}>
                  {text}
                </td>
                <td class="num">{whole(voxels)}</td>
                <td class="centre">
                  <input
                    type="checkbox"
                    aria-label={`Mesh ${text}`}
                    checked={meshed}
                    disabled={meshed && last}
                    onChange={() => toggleMesh(label)}
                  />
                </td>
                <td>
                  <NumberInput
                    label={`Edge length of ${text}`}
                    path="sizing.labels.edge_mm"
                    step={0.1}
                    value={wished.get(label) ?? null}
                    placeholder={String(current.sizing.edge_mm)}
                    disabled={!meshed}
                    onChange={(edge) => setEdge(label, edge)}
                  />
                </td>
                <td>
                  <button
                    type="button"
                    class="icon-button small"
                    aria-pressed={!hidden}
                    aria-label={`Show ${text} in the view`}
                    title={hidden ? 'Show in the view' : 'Hide in the view'}
                    onClick={() => toggleSeen(label)}
                  >
                    <Icon name={hidden ? 'eye_off' : 'eye'} size={15} />
                  </button>
                </td>
              </tr>
            );
          })}
        </tbody>
      </table></div>
      <CheckField
        label="Mesh the labels as one region"
        checked={mergesAll(current.merge, [...chosen])}
        onChange={(merge) => {
          editRecipe('Merge labels', (draft) => void (draft.merge = merge ? [[...chosen]] : []));
          previewSoon();
        }}
      />
    </section>
  );
}

function SizingSection({ current }: { current: Recipe }) {
  const number = (
    label: string,
    key: 'edge_mm' | 'edge_min_mm' | 'edge_max_mm' | 'gradation',
    unit: string,
    step: number,
  ) => (
    <Field label={label} unit={unit} hint={fieldOf(`sizing.${key}`)?.description}>
      <NumberInput
        label={label}
        path={`sizing.${key}`}
        step={step}
        value={current.sizing[key]}
        onChange={(value) =>
          value !== null && editRecipe(label, (draft) => void (draft.sizing[key] = value), key)
        }
      />
    </Field>
  );
  return (
    <section class="section">
      <h2>Element size</h2>
      {number('Edge length', 'edge_mm', 'mm', 0.1)}
      {number('Growth per mm', 'gradation', '', 0.05)}
      <RegionList current={current} />
      <details class="more">
        <summary>Bounds</summary>
        {number('Smallest edge', 'edge_min_mm', 'mm', 0.1)}
        {number('Largest edge', 'edge_max_mm', 'mm', 1)}
      </details>
    </section>
  );
}

/** Stage parameters straight from the engine's table: number, flag or choice. */
function StageSection({ current }: { current: Recipe }) {
  const rows: [keyof Recipe & ('volume' | 'surface' | 'smooth' | 'remesh' | 'tetra' | 'quality'), string][] = [
    ['volume', 'Volume'],
    ['surface', 'Label surface'],
    ['smooth', 'Smoothing'],
    ['remesh', 'Adapted surface'],
    ['tetra', 'Tetrahedra'],
    ['quality', 'Evidence'],
  ];
  return (
    <section class="section">
      <details class="more">
        <summary>Stage parameters</summary>
        {rows.map(([stage, title]) => (
          <fieldset key={stage} class="stage-fields">
            <legend>{title}</legend>
            {Object.entries(current[stage]).map(([key, value]) => {
              const field = fieldOf(`${stage}.${key}`);
              const label = (key.charAt(0).toUpperCase() + key.slice(1))
                .replace(/_(mm|deg|voxels)$/, '')
                .replaceAll('_', ' ');
              const set = (next: unknown) => {
                editRecipe(
                  label,
                  (draft) => void ((draft[stage] as Record<string, unknown>)[key] = next),
                  `${stage}.${key}`,
                );
                if (stage === 'volume' || stage === 'surface' || stage === 'smooth') previewSoon();
              };
              if (typeof value === 'boolean')
                return (
                  <CheckField
                    key={key}
                    label={label}
                    checked={value}
                    hint={field?.description}
                    onChange={set}
                  />
                );
              if (typeof value === 'string') {
                const options = (field?.values ?? [value]).map(
                  (name) => [name, name.replaceAll('_', ' ')] as const,
                );
                return (
                  <SelectField
                    key={key}
                    label={label}
                    value={value}
                    options={options}
                    hint={field?.description}
                    onChange={set}
                  />
                );
              }
              const unit = field?.unit === 'deg' ? '°' : field?.unit === 'voxel' ? 'vx' : (field?.unit ?? '');
              return (
                <Field key={key} label={label} unit={unit} hint={field?.description}>
                  <NumberInput
                    label={`${title}: ${label}`}
                    path={`${stage}.${key}`}
                    value={value as number}
                    onChange={(next) => next !== null && set(next)}
                  />
                </Field>
              );
            })}
          </fieldset>
        ))}
      </details>
    </section>
  );
}

export function CasePanel() {
  const current = recipe.value;
  const awaited = awaitedFile.value;
  if (!current) return <aside class="panel left" aria-label="Case" />;
  const chosen = current.source.phantom !== undefined || current.source.file !== undefined;
  return (
    <aside class="panel left" aria-label="Case" aria-busy={activity.value === 'opening'}>
      <SourceSection current={current} />
      {awaited && <p class="hint">This case was made from {awaited.name}. Drop that file to go on.</p>}
      {chosen && (
        <>
          <LabelTable current={current} />
          <SizingSection current={current} />
          <StageSection current={current} />
        </>
      )}
      {!chosen && (
        <p class="hint">
          Labels, sizes and stage parameters appear here once a volume is open. Files stay on this computer:
          the mesher runs in this tab.
        </p>
      )}
    </aside>
  );
}
