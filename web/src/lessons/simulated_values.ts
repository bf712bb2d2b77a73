/** What a lesson may ask of a simulation: the figures of its report, by names of ours. */
import type { Simulated, Ventricle, VentricleBeat } from '../engine/contract';

export type SimulatedRow = readonly [
  name: string,
  title: string,
  unit: string,
  of: (found: Simulated) => number | undefined,
];

export const percentOf = (share: number | undefined) => (share === undefined ? undefined : 100 * share);

export const excitation: readonly SimulatedRow[] = [
  ['wave.last_ms', 'Last point of the activation map', 'ms', ({ eikonal }) => eikonal?.last_ms],
  ['wave.activated_percent', 'Activated points', '%', ({ eikonal }) => percentOf(eikonal?.activated)],
  [
    'wave.total_ms',
    'Total activation time of the wave',
    'ms',
    ({ monodomain }) => monodomain?.total_activation_ms,
  ],
  ['wave.apd_ms', 'Mean action potential', 'ms', ({ monodomain }) => monodomain?.mean_apd_ms],
];

const ventricles: readonly [Ventricle, string][] = [
  ['lv', 'Left ventricle'],
  ['rv', 'Right ventricle'],
];
const figures: readonly [string, string, string, (beat: VentricleBeat) => number][] = [
  ['end_diastolic_ml', 'end-diastolic volume', 'ml', (beat) => beat.end_diastolic_ml],
  ['end_systolic_ml', 'end-systolic volume', 'ml', (beat) => beat.end_systolic_ml],
  ['stroke_ml', 'stroke volume', 'ml', (beat) => beat.stroke_ml],
  ['ejection_percent', 'ejection fraction', '%', (beat) => 100 * beat.ejection_fraction],
  ['most_kpa', 'highest pressure', 'kPa', (beat) => beat.most_kpa],
  ['stroke_work_j', 'stroke work', 'J', (beat) => beat.stroke_work_j],
];

/** Of the last beat. */
export const heartbeat: readonly SimulatedRow[] = [
  ...ventricles.flatMap(([side, ventricle]) =>
    figures.map(([figure, title, unit, of]): SimulatedRow => {
      const ofLast = ({ mechanics }: Simulated) => {
        const last = mechanics?.beats.at(-1);
        return last && of(last[side]);
      };
      return [`beat.${side}_${figure}`, `${ventricle}, ${title}`, unit, ofLast];
    }),
  ),
  ['beat.count', 'Beats', '', ({ mechanics }) => mechanics?.beats.length],
  [
    'beat.change_percent',
    'Change of the volumes from beat to beat',
    '%',
    ({ mechanics }) => mechanics?.change_percent,
  ],
];
