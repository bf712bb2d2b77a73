import { useEffect, useRef, useState } from 'preact/hooks';
import type { Vec3 } from '../engine/contract';
import { colourStops } from '../geometry/colours';
import { openSample } from '../store/actions';
import { awaitedFile, nameOf, volume } from '../store/input';
import { shownDigests, shownResult } from '../store/results';
import { activity, report } from '../store/run';
import {
  brush,
  colourBy,
  command,
  cut,
  focusTet,
  fractionLabel,
  legend,
  picked,
  showEdges,
  slicePlaces,
  stageShown,
  type ColourBy,
} from '../store/view';
import { short } from './format';
import { Icon } from './icons';
import { FileButton } from './source_section';

const cutAxes: [string, string, Vec3][] = [
  ['R', 'Cut from right to left', [1, 0, 0]],
  ['A', 'Cut from front to back', [0, 1, 0]],
  ['S', 'Cut from head to feet', [0, 0, 1]],
];

function lookedUpOptions(): [ColourBy, string][] {
  const arrays = Object.keys(shownResult('quality') ?? {}) as ColourBy[];
  return arrays.flatMap((name): [ColourBy, string][] => {
    if (name === 'centroid_label') return [[name, 'Centroid label']];
    if (name === 'majority_label') return [[name, 'Majority label']];
    const label = fractionLabel(name);
    return label === null ? [] : [[name, `Share of ${nameOf(label)}`]];
  });
}

function ColourChoice() {
  const stage = stageShown.value;
  const onTets = stage === 'optimise' || stage === 'quality';
  const measured = onTets && shownDigests.value.quality !== undefined;
  const options: [ColourBy, string][] = onTets
    ? [
        ['label', 'Label'],
        ['edge_mm', 'Edge length'],
        ['min_dihedral_deg', 'Smallest angle'],
        ['radius_ratio', 'Radius ratio'],
        ['size_log2', 'Achieved / prescribed'],
      ]
    : [
        ['label', 'Label'],
        ['edge_mm', 'Edge length'],
      ];
  if (onTets) options.push(...lookedUpOptions());
  const chosen = options.some(([value]) => value === colourBy.value) ? colourBy.value : 'label';
  return (
    <label class="tool-field">
      <select
        aria-label="Colour by"
        value={chosen}
        onChange={(event) => (colourBy.value = event.currentTarget.value as ColourBy)}
      >
        {options.map(([value, text]) => (
          <option
            key={value}
            value={value}
            selected={value === chosen}
            disabled={onTets && value !== 'label' && !measured}
          >
            {text}
          </option>
        ))}
      </select>
    </label>
  );
}

function CutTools() {
  const { on, normal, place } = cut.value;
  const axis = cutAxes.find(
    ([, , direction]) =>
      direction.every((part, i) => part === normal[i]) || direction.every((part, i) => -part === normal[i]),
  );
  return (
    <>
      <button
        type="button"
        class="tool"
        aria-pressed={on}
        title="Cut the body open; tetrahedra stay whole"
        onClick={() => (cut.value = { ...cut.value, on: !on })}
      >
        Cut
      </button>
      {on && (
        <div class="cut-tools">
          <div class="segments" role="group" aria-label="Direction of the cut">
            {cutAxes.map(([name, title, direction]) => (
              <button
                type="button"
                key={name}
                title={title}
                aria-label={title}
                aria-pressed={axis?.[0] === name}
                onClick={() => (cut.value = { ...cut.value, normal: direction })}
              >
                {name}
              </button>
            ))}
            <button
              type="button"
              title="Cut facing me"
              aria-pressed={!axis}
              onClick={() => (command.value = { kind: 'cut_facing_me' })}
            >
              View
            </button>
          </div>
          <input
            type="range"
            min={0}
            max={1}
            step={0.005}
            value={place}
            aria-label="Place of the cut"
            onInput={(event) => (cut.value = { ...cut.value, place: Number(event.currentTarget.value) })}
          />
          <button
            type="button"
            class="tool"
            title="Keep the other side"
            onClick={() =>
              (cut.value = {
                ...cut.value,
                normal: normal.map((part) => -part || 0) as Vec3,
                place: 1 - place,
              })
            }
          >
            Flip
          </button>
        </div>
      )}
    </>
  );
}

function SliceTools() {
  return (
    <div class="slice-tools">
      {['i', 'j', 'k'].map((name, axis) => (
        <label key={name}>
          <span>{name}</span>
          <input
            type="range"
            min={0}
            max={1}
            step={0.005}
            value={slicePlaces.value[axis]}
            aria-label={`Slice along image axis ${name}`}
            onInput={(event) => {
              const place = Number(event.currentTarget.value);
              slicePlaces.value = slicePlaces.value.map((old, i) => (i === axis ? place : old)) as Vec3;
            }}
          />
        </label>
      ))}
    </div>
  );
}

function LegendCard() {
  const shown = legend.value;
  if (!shown) return null;
  const stops = colourStops(shown.map);
  const ticks = [1, 0.75, 0.5, 0.25, 0];
  return (
    <div
      class="legend"
      role="img"
      aria-label={`${shown.title} from ${short(shown.lo)} to ${short(shown.hi)} ${shown.unit}`}
    >
      <span class="legend-title">
        {shown.title}
        {shown.unit && <span class="unit"> {shown.unit}</span>}
      </span>
      <div class="legend-body">
        <svg width="14" height="120" aria-hidden="true">
          <defs>
            <linearGradient id="legend-scale" x1="0" y1="1" x2="0" y2="0">
              {stops.map((colour, i) => (
                <stop key={colour} offset={i / (stops.length - 1)} stop-color={colour} />
              ))}
            </linearGradient>
          </defs>
          <rect width="14" height="120" rx="2" fill="url(#legend-scale)" />
        </svg>
        <div class="legend-ticks">
          {ticks.map((t) => (
            <span key={t}>{short(Number((shown.lo + t * (shown.hi - shown.lo)).toPrecision(3)))}</span>
          ))}
        </div>
      </div>
    </div>
  );
}

function PickedCard() {
  const found = picked.value;
  if (!found) return null;
  return (
    <div class="picked" role="status">
      <div class="picked-head">
        <strong>{found.title}</strong>
        <button
          type="button"
          class="icon-button small"
          aria-label="Close"
          onClick={() => {
            picked.value = null;
            focusTet.value = null;
          }}
        >
          <Icon name="cross" size={13} />
        </button>
      </div>
      <dl>
        {found.lines.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}

function EmptyState() {
  const awaited = awaitedFile.value;
  return (
    <div class="empty">
      <svg class="empty-mark" viewBox="0 0 96 84" width="96" height="84" aria-hidden="true">
        <path d="M48 4 90 76 6 76Z M48 4 58 54 90 76 M58 54 6 76" />
      </svg>
      {awaited ? (
        <>
          <h1>Drop {awaited.name}</h1>
          <p>
            The link holds the settings; the volume stays with whoever has it. Its digest says whether it is
            the one.
          </p>
          <div class="empty-actions">
            <FileButton label="Open that file…" primary />
          </div>
        </>
      ) : (
        <>
          <h1>From a segmented volume to a tetrahedral mesh</h1>
          <p>
            Drop a label volume here: NIfTI, NRRD or MetaImage. It is read and meshed in this tab; nothing is
            uploaded.
          </p>
          <div class="empty-actions">
            <FileButton label="Open a file…" primary />
            <button
              type="button"
              class="button"
              onClick={() => void openSample()}
              disabled={activity.value === 'starting'}
            >
              Take the sample heart
            </button>
          </div>
        </>
      )}
    </div>
  );
}

export function ViewPanel() {
  const host = useRef<HTMLDivElement>(null);
  const [trouble, setTrouble] = useState('');
  const opened = volume.value !== null;
  useEffect(() => {
    if (!opened || !host.current) return;
    const element = host.current;
    let unmount: (() => void) | undefined;
    let gone = false;
    import('../scene/scene').then(
      ({ mountScene }) => {
        if (gone) return;
        try {
          unmount = mountScene(element);
        } catch {
          setTrouble(
            'This browser gives no WebGL 2, so there is no 3-D view. Meshing, histograms and export work all the same.',
          );
        }
      },
      () => setTrouble('The 3-D view could not be loaded.'),
    );
    return () => {
      gone = true;
      unmount?.();
    };
  }, [opened]);

  const stage = stageShown.value;
  const sliced = stage === 'volume' || stage === 'sizing';
  return (
    <main class="view" aria-label="View">
      <div class="view-host" ref={host} />
      {!opened && <EmptyState />}
      {trouble && <p class="view-trouble">{trouble}</p>}
      {opened && (
        <>
          <div class="toolbar" role="toolbar" aria-label="View tools">
            {!sliced && <ColourChoice />}
            {!sliced && (
              <button
                type="button"
                class="tool"
                aria-pressed={showEdges.value}
                title="Element edges"
                onClick={() => (showEdges.value = !showEdges.value)}
              >
                Edges
              </button>
            )}
            {!sliced && <CutTools />}
            {sliced && <SliceTools />}
            <button
              type="button"
              class="tool icon-only"
              title="Fit to view"
              aria-label="Fit to view"
              onClick={() => (command.value = { kind: 'fit' })}
            >
              <Icon name="fit" />
            </button>
            {(focusTet.value !== null || brush.value !== null) && report.value && (
              <button
                type="button"
                class="tool accent"
                onClick={() => {
                  focusTet.value = null;
                  brush.value = null;
                  picked.value = null;
                  command.value = { kind: 'fit' };
                }}
              >
                Show all
              </button>
            )}
          </div>
          <LegendCard />
          <PickedCard />
        </>
      )}
    </main>
  );
}
