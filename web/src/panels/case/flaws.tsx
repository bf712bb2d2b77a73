import type { Flaw } from '../../engine/contract';
import { cleanLabels } from '../../store/case/clean';
import { previewSoon } from '../../store/run/run_stages';

/** Noise of the segmentation, and the click that takes it away. */
export function Flaws({ flaws }: { flaws: Flaw[] }) {
  const remedy = () => {
    cleanLabels();
    previewSoon();
  };
  return (
    <div class="stale" data-testid="flaws">
      {flaws.map(({ text }) => (
        <p key={text}>{text}</p>
      ))}
      <button type="button" class="button small" onClick={remedy}>
        Clean the labels
      </button>
    </div>
  );
}
