import { forecast } from '../../store/run/forecast';
import { runAll } from '../../store/run/run_stages';
import { Dialog } from '../controls/dialog';
import { dialogShown } from '../controls/dialog_shown';
import { forecastParts } from '../run/forecast_text';

/** Before a run that may need more memory than a tab has. */
export function MemoryDialog({ close }: { close(): void }) {
  const numbers = forecast.value?.numbers;
  const go = () => {
    close();
    void runAll();
  };
  return (
    <Dialog title="This may not fit into the tab" onClose={close}>
      <p>
        The forecast is {numbers ? forecastParts(numbers, []).join(', ') : 'unknown'}. A tab has 4 GB at most;
        where they do not suffice, the run ends with an error, and nothing of the case is lost.
      </p>
      <div class="dialog-actions">
        <button type="button" class="button" onClick={close}>
          Cancel
        </button>
        <button type="button" class="button" onClick={go}>
          Run all the same
        </button>
        <button type="button" class="button primary" onClick={() => (dialogShown.value = 'sizes')}>
          Choose other sizes…
        </button>
      </div>
    </Dialog>
  );
}
