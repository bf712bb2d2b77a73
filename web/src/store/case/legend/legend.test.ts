import { describe, expect, it } from 'vitest';
import { changedLegend } from './legend';
import { readLegend } from './legend_file';
import type { Recipe, VolumeSummary } from '../../../engine/contract';
import { volume } from '../input';
import { nameBy, schemes, schemesFor } from './schemes';

describe('a legend', () => {
  it('changes what is named and forgets what says nothing any more', () => {
    const legend = [{ label: 5, name: 'scar', colour: '' }];
    expect(
      changedLegend(legend, [
        { label: 2, colour: '#112233' },
        { label: 5, name: '' },
        { label: 1, name: 'LV' },
      ]),
    ).toEqual([
      { label: 1, name: 'LV', colour: '' },
      { label: 2, name: '', colour: '#112233' },
    ]);
    expect(changedLegend(legend, [{ label: 5, colour: '#ffffff' }])).toEqual([
      { label: 5, name: 'scar', colour: '#ffffff' },
    ]);
  });
});

describe('tables of labels', () => {
  const scar = { label: 5, name: 'scar', colour: '#c80a00' };

  it.each([
    [
      'ITK-SNAP',
      '# ITK-SnAP Label Description File\r\n  0 0 0 0 0 0 0 "Clear Label"\r\n  5 200 10 0 0.5 1 1 "scar"\r\n',
    ],
    ['3D Slicer', '# Color table file\n0 Background 0 0 0 0\n5 scar 200 10 0 255\n'],
    ['FreeSurfer', '#No. Label Name: R G B A\n\n0   Unknown   0   0   0   0\n5   scar  200 10 0 0'],
  ])('of %s are read', (_, text) => {
    expect(readLegend('table.txt', text)).toEqual([scar]);
  });

  it.each(['a 1 2 3', '5 scar 300 0 0 0', '70000 scar 1 1 1 0', '5 200 10 0 0.5 1 1 scar'])(
    'with a line that is none are refused by its number: %s',
    (line) => {
      expect(() => readLegend('table.txt', `# head\n5 scar 200 10 0 0\n${line}`)).toThrow(
        `table.txt, line 3: found "${line}", expected a label`,
      );
    },
  );
});

describe('schemes of labels', () => {
  it('have the numbers that their makers give', () => {
    const named = (title: string, label: number) =>
      schemes.find((scheme) => scheme.title.includes(title))?.names.get(label);
    expect(schemes.find(({ title }) => title === 'Whole body (TotalSegmentator)')?.names.size).toBe(117);
    for (const [label, name] of [
      [8, 'adrenal_gland_right'],
      [26, 'vertebrae_S1'],
      [50, 'vertebrae_C1'],
      [51, 'heart'],
      [69, 'humerus_left'],
      [91, 'skull'],
      [104, 'rib_right_1'],
      [117, 'costal_cartilages'],
    ] as const)
      expect(named('Whole body', label)).toBe(name);
    for (const [label, name] of [
      [41, 'Right-Cerebral-White-Matter'],
      [53, 'Right-Hippocampus'],
      [58, 'Right-Accumbens-area'],
      [63, 'Right-choroid-plexus'],
      [251, 'CC_Posterior'],
    ] as const)
      expect(named('FreeSurfer', label)).toBe(name);
  });

  it('are proposed where they have all labels, the closest first', () => {
    const titles = (labels: number[]) => schemesFor(labels).map(({ title }) => title);
    expect(titles([1, 2, 3, 4, 5, 6])[0]).toBe('Two ventricles with scar');
    expect(titles([205, 500, 600])).toEqual(['Whole heart (MM-WHS)']);
    expect(titles([2, 41, 251])).toEqual(['Brain (FreeSurfer)']);
    expect(titles([1, 2, 999])).toEqual([]);
    expect(titles([1])).toEqual([]);
  });

  it('leave cavities out of a mesh that is to be made, not of one that is given, nor where labels are chosen', () => {
    const [shortAxis] = schemesFor([1, 2, 3]);
    const named = (labels: number[]) => {
      const draft = { legend: [], labels } as unknown as Recipe;
      nameBy(shortAxis, [1, 2, 3], draft);
      expect(draft.legend.map(({ name }) => name)).toEqual(['RV_blood', 'LV_wall', 'LV_blood']);
      return draft.labels;
    };
    expect(named([])).toEqual([2]);
    expect(named([1, 2])).toEqual([1, 2]);
    volume.value = { labels: [], mesh: {} } as unknown as VolumeSummary;
    expect(named([])).toEqual([]);
    volume.value = null;
  });
});
