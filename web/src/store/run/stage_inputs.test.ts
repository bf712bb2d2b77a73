import { produce } from 'immer';
import { describe, expect, it } from 'vitest';
import { stageNames, type Recipe } from '../../engine/contract';
import createVoxtet from '../../engine/testing/mock_engine.mjs';
import { stageInput } from './stage_inputs';

const engine = await createVoxtet();
const defaults = JSON.parse(new engine.Session().defaults()) as Recipe;

const touchedBy = (change: (draft: Recipe) => void) => {
  const changed = produce(defaults, change);
  return stageNames.filter((stage) => stageInput(changed, stage) !== stageInput(defaults, stage));
};

describe('stages that an edit touches', () => {
  it('are those that read the field, and those after them', () => {
    expect(touchedBy((draft) => void (draft.sizing.edge_mm = 9))).toEqual([
      'sizing',
      'remesh',
      'optimise',
      'quality',
    ]);
    expect(touchedBy((draft) => void (draft.smooth.iterations = 9))).toEqual([
      'smooth',
      'sizing',
      'remesh',
      'optimise',
      'quality',
    ]);
    expect(touchedBy((draft) => void (draft.tetra.radius_edge = 2))).toEqual(['optimise', 'quality']);
    expect(touchedBy((draft) => void (draft.quality.histogram_bins = 9))).toEqual(['quality']);
    expect(touchedBy((draft) => void (draft.merge = [[1, 2]]))).toEqual([...stageNames]);
    const file = { name: 'a.nii', sha256: 'ab', url: '' };
    expect(touchedBy((draft) => void (draft.source.file = file))).toEqual([...stageNames]);
    const at = (url: string) => ({ ...defaults, source: { ...defaults.source, file: { ...file, url } } });
    expect(stageInput(at('https://a.org/a.nii'), 'volume')).toBe(stageInput(at(''), 'volume'));
  });
});
