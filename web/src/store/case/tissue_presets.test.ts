import { describe, expect, it } from 'vitest';
import engineSchema from '../../engine/schema.json';
import { tissuePresetOf, tissuePresets, type TissuePreset, type TissuePresetName } from './tissue_presets';

type Cell = TissuePreset['fields'];
const stepMs = 0.02;

/** Voltage of one cell over time, excited for 2 ms at its start by `strength`; the engine's two cells. */
function voltages(cell: Cell, strength: number, endMs: number): number[] {
  let [v, w] = [0, 1];
  return Array.from({ length: Math.round(endMs / stepMs) }, (_, i) => {
    const given = i * stepMs < 2 ? strength : 0;
    const inward = w * v * (cell.cell === 'mms' ? v - cell.gate : v) * ((1 - v) / cell.tau_in_ms);
    const outward = ((cell.cell === 'mms' ? 1 - w : 1) * v) / cell.tau_out_ms;
    const gate = v < cell.gate ? (1 - w) / cell.tau_open_ms : -w / cell.tau_close_ms;
    v += stepMs * (inward - outward + given);
    w += stepMs * gate;
    return v;
  });
}

const beats = (all: number[]) => all.filter((v, i) => v >= 0.5 && (all[i - 1] ?? 0) < 0.5).length;
const names = Object.keys(tissuePresets) as TissuePresetName[];

describe('presets of tissue', () => {
  it.each(names)('%s beats once when it is excited, and is then at rest for 2 s', (name) => {
    const all = voltages(tissuePresets[name].fields, 0.5, 2500);
    expect(beats(all)).toBe(1);
    expect(Math.max(...all.slice(Math.round(600 / stepMs)).map(Math.abs))).toBeLessThan(0.13);
    expect(beats(voltages(tissuePresets[name].fields, 0, 2000))).toBe(0);
  });

  it('of border zones have a tenth of the diffusivity, and act for as long as they say', () => {
    const lasted = (name: TissuePresetName) =>
      voltages(tissuePresets[name].fields, 0.5, 600).filter((v) => v > 0.13).length * stepMs;
    const speed = (name: TissuePresetName) => tissuePresets[name].fields.along_mm_per_ms;
    for (const name of ['border', 'border_brief', 'border_long'] as const)
      expect((speed(name) / speed('healthy')) ** 2).toBeCloseTo(0.1, 2);
    expect(lasted('border_brief')).toBeLessThan(lasted('border'));
    expect(lasted('border_long')).toBeGreaterThan(lasted('border'));
  });

  it('have every field of a kind but its labels, and are known by their values', () => {
    const { items = [] } = (engineSchema.fields as { path: string; items?: { path: string }[] }[]).find(
      ({ path }) => path === 'physics.tissue.kinds',
    )!;
    for (const name of names) {
      const { fields } = tissuePresets[name];
      expect(['labels', ...Object.keys(fields)].sort()).toEqual(items.map(({ path }) => path).sort());
      expect(tissuePresetOf({ labels: [1], ...fields }, true)).toBe(name);
    }
    const own = { labels: [1], ...tissuePresets.healthy.fields, across_mm_per_ms: 0.5 };
    expect(tissuePresetOf(own, true)).toBeNull();
    expect(tissuePresetOf(own, false)).toBe('healthy');
  });
});
