import { describe, expect, it } from 'vitest';
import type { Report } from '../../engine/contract';
import { alignment, report } from './report';

const slices = [{ slice: 3, move_mm: [2, -1], given: false, dice_before: 0.5, dice_after: 0.8 }];

function told(counts: Record<string, unknown>) {
  report.value = { stages: [{ name: 'volume', counts }] } as unknown as Report;
}

describe('alignment', () => {
  it('is what the report says of the slices of its volume', () => {
    told({ alignment: { axis: 2, spread_mm: 2.9, slices } });
    expect(alignment.value?.slices).toEqual(slices);
  });

  it('is null where no slice was moved', () => {
    told({});
    expect(alignment.value).toBeNull();
  });
});
