import { comparedFields, differenceFound } from '../../store/run/simulated_fields';
import { colourBy } from '../../store/view';
import { short, whole } from '../controls/format';

const digits = (value: number): string => short(Number(value.toPrecision(3)));

/** How far this simulation is from the pinned one, field by field; a click colours the mesh by it. */
export function SimulatedDifferences() {
  const rows = comparedFields.value.flatMap(({ info, played }) => {
    const found = played ? undefined : differenceFound(info.name);
    return found ? [{ info, found }] : [];
  });
  if (rows.length === 0) return null;
  const one = Math.max(...rows.map(({ found }) => found.one));
  return (
    <>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Differences of the two simulations">
        <table class="measures tight" data-testid="simulated-differences">
          <thead>
            <tr>
              <th scope="col">This run less the pinned one</th>
              {['Mean', 'Rms', 'Largest'].map((name) => (
                <th key={name} scope="col" class="num">
                  {name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {rows.map(({ info, found }) => (
              <tr key={info.name}>
                <th scope="row">
                  <button
                    type="button"
                    class="link-button"
                    title="Colours the mesh by it"
                    onClick={() => (colourBy.value = `difference_${info.name}`)}
                  >
                    {info.title}
                  </button>{' '}
                  <span class="unit">{info.unit}</span>
                </th>
                <td class="num">{digits(found.mean)}</td>
                <td class="num">{digits(found.rms)}</td>
                <td class="num">{digits(found.largest)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {one > 0 && <p class="hint">Up to {whole(one)} points have a value in one of the runs only.</p>}
    </>
  );
}
