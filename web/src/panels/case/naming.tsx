import { volume } from '../../store/case/input';
import { nameOf, unnamed } from '../../store/case/legend/legend';
import { leaveOut } from '../../store/case/legend/proposals';
import { nameBy, schemesFor, type Scheme } from '../../store/case/legend/schemes';
import { editRecipe } from '../../store/case/recipe';
import { previewSoon } from '../../store/run/run_stages';

const most = 3;

/** Proposes names where a file gives its labels none, by the numberings that have all of them. */
export function Naming() {
  const labels = volume.value?.labels.map(({ label }) => label) ?? [];
  const fitting = unnamed.value ? schemesFor(labels).slice(0, most) : [];
  if (fitting.length === 0) return null;
  const choose = (scheme: Scheme) => {
    editRecipe('Names of labels', (draft) => nameBy(scheme, labels, draft));
    previewSoon();
  };
  return (
    <div class="naming" data-testid="naming">
      <p>The file does not name its labels. By their numbers they may be:</p>
      {fitting.map((scheme) => (
        <button
          type="button"
          key={scheme.title}
          class="button small"
          title={
            scheme.cavities.size > 0 ? 'Takes the names, and leaves blood out of the mesh' : 'Takes the names'
          }
          onClick={() => choose(scheme)}
        >
          {scheme.title}
        </button>
      ))}
      <p>Or click a name to change it, or drop a label table (.txt, .ctbl).</p>
    </div>
  );
}

/** Proposes to leave out a label that surrounds all others. */
export function Background({ label }: { label: number }) {
  const labels = volume.value?.labels.map((one) => one.label) ?? [];
  const leave = () => {
    editRecipe('Background left out', (draft) => leaveOut(label, labels, draft));
    previewSoon();
  };
  return (
    <div class="naming" data-testid="background">
      <p>{nameOf(label)} surrounds everything else. Is it the background?</p>
      <button type="button" class="button small" onClick={leave}>
        Leave it out of the mesh
      </button>
    </div>
  );
}
