import type { SliceAlignment } from '../../engine/contract';
import { short } from '../controls/format';

/** What was moved, slice by slice, and how much more of its neighbours each slice overlaps since. */
export function AlignmentSection({ found }: { found: SliceAlignment }) {
  const moved = found.slices.filter(({ move_mm: [first, second] }) => first !== 0 || second !== 0);
  return (
    <section class="section">
      <h2>Slices moved</h2>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Slices moved">
        <table class="measures" data-testid="alignment">
          <thead>
            <tr>
              <th scope="col">Slice</th>
              <th scope="col" class="num">
                Move mm
              </th>
              <th scope="col" class="num">
                Dice
              </th>
            </tr>
          </thead>
          <tbody>
            {moved.map(({ slice, move_mm, given, dice_before, dice_after }) => (
              <tr key={slice}>
                <th scope="row">
                  {slice}
                  {given && ' (given)'}
                </th>
                <td class="num">{move_mm.map(short).join(', ')}</td>
                <td class="num">
                  {dice_before.toFixed(3)} → {dice_after.toFixed(3)}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="facts">
        Moves along the two image axes of a slice. Dice is of the labels of a slice and its neighbours, before
        and after. A motion of the whole and a shear along the stack show in no stack and stay.
      </p>
    </section>
  );
}
