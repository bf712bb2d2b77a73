import type { Report } from '../../engine/contract';
import { pinned, pinRun, unpin } from '../../store/run/compare';
import { comparedFields } from '../../store/run/simulated_fields';
import { chooseLayout, layout } from '../../store/view';
import { fetched } from '../controls/fetched';
import { Icon } from '../controls/icons';

const Differences = fetched(() => import('./differences').then((part) => part.Differences));

/** A run is pinned; the next ones stand beside it. */
export function CompareSection({ found }: { found: Report }) {
  const run = pinned.value;
  const simulated = comparedFields.value.length > 0;
  const same = run?.report === found && !simulated;
  return (
    <section class="section compare">
      <h2>Compare</h2>
      {!run && (
        <p class="hint">Pin this run, change something, run or simulate again: both stand side by side.</p>
      )}
      {same && <p class="hint">This run is pinned. Change something and run or simulate again to compare.</p>}
      <div class="compare-actions">
        {!same && (
          <button type="button" class="button small" onClick={pinRun}>
            <Icon name="pin" size={13} /> {run ? 'Pin this run instead' : 'Pin this run'}
          </button>
        )}
        {run && (
          <button type="button" class="button small" onClick={unpin}>
            Unpin
          </button>
        )}
        {run && !same && layout.value !== 'compare' && (
          <button type="button" class="button small" onClick={() => chooseLayout('compare')}>
            Side by side
          </button>
        )}
      </div>
      {run && !same && <Differences run={run} found={found} />}
    </section>
  );
}
