import type { Recipe } from '../engine/contract';
import { previewSoon } from '../store/runs';
import { awaitedFile, volume } from '../store/input';
import { carrierOf, dropIdleSizes, groupsOf } from '../store/labels';
import { editRecipe, recipe } from '../store/recipe';
import { activity } from '../store/run';
import { colourOf, hiddenLabels, ownColours } from '../store/view';
import { NumberField, NumberInput } from './fields';
import { whole } from './format';
import { Icon } from './icons';
import { LookUpFields } from './look_up_fields';
import { MergeFields } from './merge_fields';
import { RegionList } from './region_list';
import { SourceSection } from './source_section';
import { StageSection } from './stage_section';

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
      dropIdleSizes(draft, next);
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
      <div class="label-scroll">
        <table class="labels">
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
                      disabled={!meshed || carrierOf(current.merge, label) !== label}
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
        </table>
      </div>
      <MergeFields current={current} chosen={[...chosen]} />
      <LookUpFields current={current} />
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
    <NumberField
      label={label}
      unit={unit}
      path={`sizing.${key}`}
      step={step}
      value={current.sizing[key]}
      onChange={(value) => editRecipe(label, (draft) => void (draft.sizing[key] = value), key)}
    />
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
