import { describe, expect, it } from 'vitest';
import { faultsOf } from '../check_rules.mjs';

describe('the rules of src/', () => {
  it.each([
    ['panels/a.tsx', "import { Mesh } from 'three';", 'three'],
    ['scene/a.ts', "import { Run } from '../panels/run';", 'panels/run'],
    ['geometry/a.ts', "import { recipe } from '../store/recipe';", 'store/recipe'],
    ['store/a.ts', "const lazy = import('../scene/scene');", 'scene/scene'],
    ['panels/a.tsx', "import leftPad from 'left-pad';", 'left-pad'],
    ['store/a.ts', 'let x: any = 1;', 'any'],
    ['store/a.ts', 'const x = y as any;', 'any'],
    ['store/a.ts', 'x\n'.repeat(401), '401 lines'],
  ])('find what breaks them: %s %s', (path, text, word) => {
    expect(faultsOf(path, text).join()).toContain(word);
  });

  it('let everything else be', () => {
    const text = "import { signal } from '@preact/signals';\n// any thing: any\nexport const x = 'as any';\n";
    expect(faultsOf('store/a.ts', text)).toEqual([]);
  });
});
