import { describe, expect, it } from 'vitest';
import type { LabelTopology, Report } from '../../engine/contract';
import { distanceText, notesOf, percent, topologyRow } from './fidelity_text';

const kept: LabelTopology = {
  label: 5,
  components: [1, 1],
  cavities: [0, 0],
  handles: [2, 2],
  euler: [-2, -2],
  pinched_edges: 0,
  pinched_points: 0,
};

describe('topologyRow', () => {
  it('shows one number where nothing changed', () => {
    const row = topologyRow(kept);
    expect(row.handles).toEqual({ text: '2', changed: false });
    expect(row.pinched).toEqual({ text: '0', changed: false });
  });

  it('marks each number that changed, and pinches', () => {
    const row = topologyRow({ ...kept, handles: [2, 0], pinched_edges: 3, pinched_points: 1 });
    expect(row.components.changed).toBe(false);
    expect(row.handles).toEqual({ text: '2 → 0', changed: true });
    expect(row.pinched).toEqual({ text: '4', changed: true });
  });
});

describe('percent', () => {
  it('has a sign where there is something to it', () => {
    expect([1.234, -0.861, -0.001].map(percent)).toEqual(['+1.23 %', '−0.86 %', '0.00 %']);
  });
});

describe('distanceText', () => {
  const found = {
    samples: 9,
    spacing_mm: 0.25,
    mean_mm: 0.0631,
    rms_mm: 0.08,
    p95_mm: 0.184,
    max_mm: 0.8541,
    uncertainty_mm: 0.05,
  };

  it('gives the largest as a range where the search left one', () => {
    expect(distanceText(found)).toBe('mean 0.0631 mm, 95 % below 0.184 mm, largest 0.854 to 0.904 mm');
  });

  it('gives one number where the range does not show', () => {
    expect(distanceText({ ...found, uncertainty_mm: 1e-9 })).toMatch(/largest 0\.854 mm$/);
  });
});

describe('notesOf', () => {
  it('names the stage of each note, in the order of stages', () => {
    const found = {
      stages: [
        { name: 'remesh', notes: ['taken: remesh', 'two rounds'] },
        { name: 'quality', notes: [] },
        { name: 'tetra', notes: ['rung 2'] },
      ],
    } as unknown as Report;
    expect(notesOf(found)).toEqual(['remesh: taken: remesh', 'remesh: two rounds', 'tetra: rung 2']);
  });
});
