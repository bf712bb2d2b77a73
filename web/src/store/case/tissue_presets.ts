/** Kinds of tissue by name: values to begin with, which fill the fields of one kind. */
import type { TissueKind } from '../../engine/contract';

export interface TissuePreset {
  title: string;
  hint: string;
  fields: Omit<TissueKind, 'labels'>;
}

/** Speed across the fibres as a part of that along them: 0.5 and 0.2 m/s in healthy muscle. */
export const acrossShare = 0.4;

/** The cell of Mitchell and Schaeffer, Bulletin of Mathematical Biology 65 (2003), with their times. */
const healthy: TissuePreset['fields'] = {
  along_mm_per_ms: 0.5,
  across_mm_per_ms: 0.2,
  cell: 'ms',
  tau_in_ms: 0.3,
  tau_out_ms: 6,
  tau_open_ms: 120,
  tau_close_ms: 150,
  gate: 0.13,
};

/**
 * A tenth of the diffusivity, so that the wave is slower by the root of that. The cell is that of Corrado and Niederer,
 * Mathematical Biosciences 281 (2016), which does not pace by itself whatever its times are.
 */
const slow: TissuePreset['fields'] = {
  ...healthy,
  along_mm_per_ms: 0.16,
  across_mm_per_ms: 0.064,
  cell: 'mms',
};

export const tissuePresets = {
  healthy: { title: 'Healthy muscle', hint: '0.5 m/s along the fibres, 0.2 across.', fields: healthy },
  border: { title: 'Border zone, slow', hint: 'A tenth of the diffusivity.', fields: slow },
  border_brief: {
    title: 'Border zone, slow and brief',
    hint: 'The wave is slow and cells recover early: it finds a way back in less room.',
    fields: { ...slow, tau_close_ms: 95, tau_open_ms: 80 },
  },
  border_long: {
    title: 'Border zone, slow and long',
    hint: 'The wave is slow and cells recover late: an early beat is blocked.',
    fields: { ...slow, tau_close_ms: 200 },
  },
} satisfies Record<string, TissuePreset>;

export type TissuePresetName = keyof typeof tissuePresets;

/** The preset whose values a kind has; its speed across the fibres counts where there are some. */
export function tissuePresetOf(kind: TissueKind, hasFibres: boolean): TissuePresetName | null {
  const names = Object.keys(tissuePresets) as TissuePresetName[];
  const isSame = (name: TissuePresetName) => {
    const { fields } = tissuePresets[name];
    return (Object.keys(fields) as (keyof typeof fields)[]).every(
      (key) => fields[key] === kind[key] || (key === 'across_mm_per_ms' && !hasFibres),
    );
  };
  return names.find(isSame) ?? null;
}
