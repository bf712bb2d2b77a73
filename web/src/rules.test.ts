import { describe, expect, it } from 'vitest';
import { crowdedFolders, faultsOf } from '../check_rules.mjs';

describe('the rules of src/', () => {
  it.each([
    ['panels/a.tsx', "import { Mesh } from 'three';", 'three'],
    ['scene/a.ts', "import { Run } from '../panels/run';", 'panels/run'],
    ['geometry/a.ts', "import { recipe } from '../store/recipe';", 'store/recipe'],
    ['store/a.ts', "const lazy = import('../scene/scene');", 'scene/scene'],
    ['panels/controls/a.tsx', "import { RegionList } from '../case/region_list';", 'panels/case/region_list'],
    ['panels/run/a.tsx', "import { Dialogs } from '../dialogs/dialogs';", 'panels/dialogs/dialogs'],
    ['panels/case/a.tsx', "import { Scene } from '../../scene/scene';", 'scene/scene'],
    ['panels/view/a.tsx', "import { Canvas } from '../../scene/frame/canvas';", 'scene/frame/canvas'],
    ['store/run/a.ts', "import { paint } from '../case/painting';", 'store/case/painting'],
    ['store/notices.ts', "import { report } from './run/report';", 'store/run/report'],
    ['scene/mesh/a.ts', "import { SlicePane } from '../slices/slice_pane';", 'scene/slices/slice_pane'],
    ['scene/frame/a.ts', "import { describe } from '../describe';", 'scene/describe'],
    ['panels/a.tsx', "import leftPad from 'left-pad';", 'left-pad'],
    ['store/a.ts', 'let x: any = 1;', 'any'],
    ['store/a.ts', 'const x = y as any;', 'any'],
    ['store/a.ts', 'x\n'.repeat(401), '401 lines'],
  ])('find what breaks them: %s %s', (path, text, word) => {
    expect(faultsOf(path, text).join()).toContain(word);
  });

  it('find a folder that holds too many files, tests left out', () => {
    const files = Array.from({ length: 21 }, (_, i) => `panels/case/part_${i}.tsx`);
    expect(crowdedFolders(files)).toEqual(['panels/case: 21 files, more than 20; make rooms in it']);
    expect(crowdedFolders([...files.slice(1), 'panels/case/a.test.ts', 'panels/run/b.tsx'])).toEqual([]);
  });

  it('let everything else be', () => {
    const text = "import { signal } from '@preact/signals';\n// any thing: any\nexport const x = 'as any';\n";
    expect(faultsOf('store/a.ts', text)).toEqual([]);
    const sister = "import { Icon } from './icons';\nimport { recipe } from '../../store/case/recipe';\n";
    expect(faultsOf('panels/controls/a.tsx', sister)).toEqual([]);
    expect(faultsOf('store/run/a.ts', "import { recipe } from '../case/recipe';\n")).toEqual([]);
  });
});
