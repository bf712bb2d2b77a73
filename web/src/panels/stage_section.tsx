import type { Recipe } from '../engine/contract';
import { previewSoon } from '../store/actions';
import { editRecipe } from '../store/recipe';
import { CheckField, Field, fieldOf, NumberInput, SelectField } from './fields';
import { choiceWords, fieldUnit, fieldWords } from './stage_words';

type StageGroup = 'volume' | 'surface' | 'smooth' | 'remesh' | 'tetra' | 'quality';

const groups: readonly (readonly [StageGroup, string])[] = [
  ['volume', 'Volume'],
  ['surface', 'Label surface'],
  ['smooth', 'Smoothing'],
  ['remesh', 'Adapted surface'],
  ['tetra', 'Tetrahedra'],
  ['quality', 'Evidence'],
];

const previewed = new Set<StageGroup>(['volume', 'surface', 'smooth']);

/** One field as the engine's table has it: number, flag or choice. */
function StageField(props: { group: StageGroup; title: string; name: string; value: unknown }) {
  const { group, title, name, value } = props;
  const path = `${group}.${name}`;
  const field = fieldOf(path);
  const label = fieldWords(path);
  const set = (next: unknown) => {
    editRecipe(label, (draft) => void ((draft[group] as Record<string, unknown>)[name] = next), path);
    if (previewed.has(group)) previewSoon();
  };
  if (typeof value === 'boolean')
    return <CheckField label={label} checked={value} hint={field?.description} onChange={set} />;
  if (typeof value === 'string') {
    const options = (field?.values ?? [value]).map((choice) => [choice, choiceWords(path, choice)] as const);
    return (
      <SelectField label={label} value={value} options={options} hint={field?.description} onChange={set} />
    );
  }
  return (
    <Field label={label} unit={fieldUnit(path, field?.unit)} hint={field?.description}>
      <NumberInput
        label={`${title}: ${label}`}
        path={path}
        value={value as number}
        onChange={(next) => next !== null && set(next)}
      />
    </Field>
  );
}

export function StageSection({ current }: { current: Recipe }) {
  return (
    <section class="section">
      <details class="more">
        <summary>Stage parameters</summary>
        {groups.map(([group, title]) => (
          <fieldset key={group} class="stage-fields">
            <legend>{title}</legend>
            {Object.entries(current[group]).map(([name, value]) => (
              <StageField key={name} group={group} title={title} name={name} value={value} />
            ))}
          </fieldset>
        ))}
      </details>
    </section>
  );
}
