import { useEffect, useRef, useState } from 'preact/hooks';
import type { LabelSummary, Recipe, VolumeSummary } from '../../engine/contract';
import { meshIsGiven, volume } from '../../store/case/input';
import { carrierOf, dropIdleSizes, groupedWith, groupsOf, meshedLabels } from '../../store/case/labels';
import { editRecipe } from '../../store/case/recipe';
import { previewSoon } from '../../store/run/run_stages';
import { hiddenLabels, labelPicked } from '../../store/view';
import { NumberInput } from '../controls/fields';
import { short, whole } from '../controls/format';
import { Icon } from '../controls/icons';
import { colourOf, editLegend, nameOf } from '../../store/case/legend/legend';

const manyLabels = 12;
const textOf = ({ label }: LabelSummary): string => nameOf(label);

function toggleMesh(known: VolumeSummary, chosen: ReadonlySet<number>, label: number): void {
  editRecipe(chosen.has(label) ? 'Leave label out' : 'Mesh label', (draft) => {
    const next = known.labels
      .map((entry) => entry.label)
      .filter((one) => (one === label ? !chosen.has(one) : chosen.has(one)));
    draft.labels = next.length === known.labels.length ? [] : next;
    draft.merge = groupsOf(draft.merge, [...chosen], next);
    dropIdleSizes(draft, next);
  });
  previewSoon();
}

function setEdge(label: number, edge: number | null): void {
  editRecipe(
    'Edge length of label',
    (draft) => {
      const others = draft.sizing.labels.filter((entry) => entry.label !== label);
      if (edge !== null) others.push({ label, edge_mm: edge });
      draft.sizing.labels = others.sort((a, b) => a.label - b.label);
    },
    `label edge ${label}`,
  );
}

function toggleSeen(label: number): void {
  const next = new Set(hiddenLabels.value);
  if (!next.delete(label)) next.add(label);
  hiddenLabels.value = next;
}

/** Without a name it has that of the file again. */
function rename(label: number, name: string): void {
  editLegend('Name of label', [{ label, name }]);
}

/** Which region of the mesh a label goes into: its own, or that of another label. */
function RegionChoice(props: { current: Recipe; entry: LabelSummary; chosen: LabelSummary[] }) {
  const { current, entry, chosen } = props;
  const { merge } = current;
  const carriers = chosen.filter(({ label }) => carrierOf(merge, label) === label && label !== entry.label);
  const carrier = carrierOf(merge, entry.label);
  // Dozens of labels make thousands of choices; each list is filled when it is about to be opened.
  const [near, setNear] = useState(false);
  const listed =
    near || chosen.length <= manyLabels ? carriers : carriers.filter(({ label }) => label === carrier);
  const join = (other: number) => {
    editRecipe('Merge labels', (draft) => {
      draft.merge = groupedWith(merge, entry.label, other);
      dropIdleSizes(
        draft,
        chosen.map(({ label }) => label),
      );
    });
    previewSoon();
  };
  return (
    <span class={carrier === entry.label ? 'into' : 'into joined'}>
      {carrier}
      <select
        aria-label={`Region of ${textOf(entry)}`}
        title="The region of the mesh that it goes into"
        value={String(carrier)}
        onPointerEnter={() => setNear(true)}
        onFocus={() => setNear(true)}
        onChange={(event) => join(Number(event.currentTarget.value))}
      >
        <option value={String(entry.label)} selected={carrier === entry.label}>
          {entry.label} (its own)
        </option>
        {listed.map((other) => (
          <option key={other.label} value={String(other.label)} selected={carrier === other.label}>
            {other.label} with {textOf(other)}
          </option>
        ))}
      </select>
    </span>
  );
}

/** Brings the marked row into sight of its panel; the page stays where it is. */
function showRow(row: Element | null | undefined): void {
  const panel = row?.closest('.panel');
  if (!row || !panel) return;
  const [own, seen] = [row.getBoundingClientRect(), panel.getBoundingClientRect()];
  if (own.top < seen.top || own.bottom > seen.bottom) panel.scrollTop += own.top - seen.top - seen.height / 2;
}

export function LabelTable({ current }: { current: Recipe }) {
  const body = useRef<HTMLTableSectionElement>(null);
  const picked = labelPicked.value;
  useEffect(() => showRow(body.current?.querySelector('.picked-label')), [picked]);
  const known = volume.value;
  if (!known) return null;
  const all = known.labels;
  const chosenLabels = meshedLabels.value;
  const chosen = all.filter(({ label }) => chosenLabels.has(label));
  const targets = new Map(current.sizing.labels.map((entry) => [entry.label, entry.edge_mm]));
  const voxelMl = known.spacing_mm.reduce((product, step) => product * step, 1) / 1000;
  const heads: [string, string][] = [
    ['Label', ''],
    ['Mesh', 'Whether it is meshed'],
    ['Into', 'The region of the mesh that it goes into'],
  ];
  if (!meshIsGiven.value) heads.push(['Edge mm', 'Target edge length inside it']);
  return (
    <div class="label-scroll">
      <table class="labels">
        <thead>
          <tr>
            <th scope="col">
              <span class="sr">Colour</span>
            </th>
            {heads.map(([name, title]) => (
              <th key={name} scope="col" title={title}>
                {name}
              </th>
            ))}
            <th scope="col">
              <span class="sr">Show</span>
            </th>
          </tr>
        </thead>
        <tbody ref={body}>
          {all.map((entry) => {
            const { label, voxels } = entry;
            const meshed = chosenLabels.has(label);
            const text = textOf(entry);
            const hidden = hiddenLabels.value.has(label);
            return (
              <tr
                key={label}
                class={`${meshed ? '' : 'off'} ${label === picked ? 'picked-label' : ''}`}
                aria-current={label === picked ? 'true' : undefined}
              >
                <td>
                  <input
                    type="color"
                    class="swatch"
                    aria-label={`Colour of ${text}`}
                    value={colourOf.value(label)}
                    onInput={(event) =>
                      editLegend(
                        'Colour of label',
                        [{ label, colour: event.currentTarget.value }],
                        `colour ${label}`,
                      )
                    }
                  />
                </td>
                <td
                  class="label-name"
                  title={`${text}, label ${label}: ${whole(voxels)} voxels, ${short(voxels * voxelMl)} ml`}
                >
                  <input
                    class="name-input"
                    aria-label={`Name of label ${label}`}
                    value={text}
                    onChange={(event) => rename(label, event.currentTarget.value.trim())}
                  />
                  <span class="label-counts">
                    <span>{whole(voxels)} ·</span> <span>{short(voxels * voxelMl)} ml</span>
                  </span>
                </td>
                <td class="centre">
                  <label class="target">
                    <input
                      type="checkbox"
                      aria-label={`Mesh ${text}`}
                      checked={meshed}
                      disabled={meshed && chosen.length === 1}
                      onChange={() => toggleMesh(known, chosenLabels, label)}
                    />
                  </label>
                </td>
                <td>
                  {meshed && chosen.length > 1 && (
                    <RegionChoice current={current} entry={entry} chosen={chosen} />
                  )}
                </td>
                {!meshIsGiven.value && (
                  <td>
                    <NumberInput
                      label={`Edge length of ${text}`}
                      path="sizing.labels.edge_mm"
                      step={0.1}
                      value={targets.get(label) ?? null}
                      placeholder={String(current.sizing.edge_mm)}
                      disabled={!meshed || carrierOf(current.merge, label) !== label}
                      onChange={(edge) => setEdge(label, edge)}
                    />
                  </td>
                )}
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
  );
}
