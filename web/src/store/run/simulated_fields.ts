/** All that a mesh can be coloured by of its simulations: what is played, what was found, and what comes of both. */
import { computed } from '@preact/signals';
import type { FieldInfo } from '../../engine/contract';
import { colourBy, time } from '../view';
import { differencesOf, pinnedSimulation, type ValueDifferences } from './compare';
import {
  foundFields,
  foundValues,
  frameAt,
  frameShown,
  keptSimulation,
  ofBeat,
  playedFields,
  type PlayedField,
} from './frames';
import { phaseDegrees, phaseDelayMs } from './phase';

const voltage = 'voltage_mV';
const phase = 'phase_deg';
const differencePrefix = 'difference_';

/** Which beat of how many the mesh is coloured by; fields that are of no beat are one of one. */
export const beatShown = computed(() => {
  const name = colourBy.value.replace(differencePrefix, '');
  const first = ofBeat(name, 1);
  const count = foundFields.value.filter(({ info }) => ofBeat(info.name, 1) === first).length;
  return { beat: Number(/_(\d+)_ms$/.exec(name)?.[1] ?? 1), count };
});

export function showBeat(beat: number): void {
  colourBy.value = ofBeat(colourBy.value, beat);
}

/** What was found, but of later beats only the one that is shown: there may be twenty. */
const offeredFields = computed((): PlayedField[] =>
  foundFields.value.filter(({ info: { name } }) => {
    const first = ofBeat(name, 1);
    return first === name || !foundValues(first) || colourBy.value.endsWith(name);
  }),
);

const phaseField = computed((): PlayedField[] => {
  const played = playedFields.value.find(({ info }) => info.name === voltage);
  if (!played) return [];
  const info = { ...played.info, name: phase, title: 'Phase', unit: 'deg', scale: 'cyclic' } as const;
  return [{ info, range: [-180, 180] }];
});

/** Times and voltages at points that both this run and the pinned one have, on the same mesh, unless they are the same. */
export const comparedFields = computed((): { info: FieldInfo; played: boolean }[] => {
  const then = pinnedSimulation();
  if (!then) return [];
  const isExcitation = ({ info: { on, unit } }: PlayedField) =>
    on === 'points' && (unit === 'ms' || unit === 'mV');
  const now = keptSimulation();
  const played = playedFields.value.filter(
    ({ info }) => then.frames !== now.frames && then.frames.at(0)?.values[info.name],
  );
  const found = offeredFields.value.filter(({ info: { name } }) => {
    const before = then.found.get(name);
    return before && before !== foundValues(name);
  });
  return [
    ...played.filter(isExcitation).map(({ info }) => ({ info, played: true })),
    ...found.filter(isExcitation).map(({ info }) => ({ info, played: false })),
  ];
});

const differenceFields = computed((): PlayedField[] =>
  comparedFields.value.map(({ info, played }) => {
    const title = `Difference of ${info.title[0].toLowerCase()}${info.title.slice(1)}`;
    const told = { ...info, name: differencePrefix + info.name, title, scale: 'diverging' } as const;
    // Of what is played as wide as its own range: a colour means the same in each frame.
    const [lo, hi] = playedFields.value.find((one) => one.info === info)?.range ?? [0, 1];
    const largest = played ? hi - lo : differenceFound(info.name)?.largest || 1;
    return { info: told, range: [-largest, largest] };
  }),
);

export const simulatedFields = computed((): PlayedField[] => [
  ...playedFields.value,
  ...phaseField.value,
  ...offeredFields.value,
  ...differenceFields.value,
]);

/** Of each field the last differences, since views and words ask for the same. */
const known = new Map<string, { now: Float32Array; before: Float32Array; made: ValueDifferences }>();

/** This run's values less the pinned one's; of what is played at the time cursor. Nothing where one of them has none. */
export function differenceFound(name: string): ValueDifferences | undefined {
  const [now, before] = [ownValues(name), pinnedValues(name)];
  if (!now || now.length !== before?.length) return undefined;
  const last = known.get(name);
  if (last?.now === now && last.before === before) return last.made;
  const made = differencesOf(now, before);
  known.set(name, { now, before, made });
  return made;
}

const isPlayed = (name: string): boolean => playedFields.value.some(({ info }) => info.name === name);

function ownValues(name: string): Float32Array | undefined {
  void foundFields.value;
  return isPlayed(name) ? frameShown.value?.values[name] : foundValues(name);
}

/** Values of the pinned run, of what is played at the same time. */
export function pinnedValues(name: string): Float32Array | undefined {
  const then = pinnedSimulation();
  return isPlayed(name) ? then?.frames.at(time.value)?.values[name] : then?.found.get(name);
}

/** Values that the mesh is coloured by, of the frame at the time cursor or as they were found. */
export function simulatedValues(name: string): Float32Array | undefined {
  if (name.startsWith(differencePrefix)) return differenceFound(name.slice(differencePrefix.length))?.values;
  if (name !== phase) return ownValues(name);
  const now = frameShown.value;
  const before = now && frameAt(now.timeMs - phaseDelayMs);
  return now?.values[voltage] && before?.values[voltage]
    ? phaseDegrees(now.values[voltage], before.values[voltage])
    : undefined;
}
