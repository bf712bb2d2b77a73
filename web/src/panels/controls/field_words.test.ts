import { describe, expect, it } from 'vitest';
import { pathWords } from './field_words';

describe('paths of the recipe in words', () => {
  it.each([
    ['sizing.edge_mm', 'Element size: edge length', ' mm'],
    ['sizing.labels.2.edge_mm', 'Element size: edge length of a label, number 3', ' mm'],
    ['optimise.min_dihedral_deg', 'Better shapes: work below', '°'],
    ['surface.something_new', 'Label surface: something new', ''],
    ['labels', 'Labels', ''],
  ])('%s', (path, name, unit) => {
    expect(pathWords(path)).toEqual({ name, unit });
  });
});
