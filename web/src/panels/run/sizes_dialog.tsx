import { useEffect, useState } from 'preact/hooks';
import { EngineError, type FittingSizes } from '../../engine/contract';
import { exceeded, fitSizes, forecast, useSizes } from '../../store/run/forecast';
import { Dialog } from '../controls/dialog';
import { NumberInput } from '../controls/fields';
import { forecastParts } from './forecast_text';
import { short } from '../controls/format';

/** The limit that the recipe is beyond, or about what it gives now. */
function firstCount(): number {
  const limit = exceeded.value.find(({ field }) => field === 'tets')?.limit;
  return limit ?? Number((forecast.value?.numbers?.tets ?? 100_000).toPrecision(1));
}

/** Which edge lengths give so many tetrahedra? */
export function SizesDialog({ close }: { close(): void }) {
  const [elements, setElements] = useState(firstCount);
  const [found, setFound] = useState<{ elements: number; fitting: FittingSizes } | null>(null);
  const [problem, setProblem] = useState('');
  const [asking, setAsking] = useState(false);
  const [search] = useState(() => new AbortController());
  useEffect(() => () => search.abort(), []);
  const ask = async () => {
    setAsking(true);
    setFound(null);
    setProblem('');
    try {
      setFound({ elements, fitting: await fitSizes(elements, search.signal) });
    } catch (error) {
      if (!(error instanceof EngineError) || error.code !== 'cancelled') setProblem((error as Error).message);
    } finally {
      setAsking(false);
    }
  };
  const fitting = found?.fitting;
  return (
    <Dialog title="Sizes for a number of tetrahedra" onClose={close}>
      <p class="muted">
        All edge lengths of the case are multiplied by one factor. Layers, images of sizes and bounds stay.
      </p>
      <form
        class="dialog-row"
        // Its step is for the arrows; any number may be asked for.
        noValidate
        onSubmit={(event) => {
          event.preventDefault();
          void ask();
        }}
      >
        <span>Tetrahedra</span>
        <NumberInput
          label="Tetrahedra"
          path="limits.tets"
          step={1000}
          value={elements}
          onChange={(value) => value !== null && value > 0 && setElements(value)}
        />
        <button type="submit" class="button" disabled={asking}>
          {asking ? 'Looking…' : 'Find sizes'}
        </button>
      </form>
      <div role="status" class="fitting">
        {fitting && (
          <>
            <strong>Edge length {short(fitting.sizing.edge_mm)} mm</strong>
            <span>
              {short(fitting.factor)} times every edge length:{' '}
              {forecastParts(fitting.forecast, []).join(', ')}.
            </span>
          </>
        )}
        {problem && <span class="stale">{problem}</span>}
      </div>
      <div class="dialog-actions">
        <button type="button" class="button" onClick={close}>
          Close
        </button>
        <button
          type="button"
          class="button primary"
          disabled={!found}
          onClick={() => {
            if (found) useSizes(found.fitting, found.elements);
            close();
          }}
        >
          Use these sizes
        </button>
      </div>
    </Dialog>
  );
}
