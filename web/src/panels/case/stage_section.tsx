import type { Recipe, SchemaField } from '../../engine/contract';
import { previewSoon } from '../../store/run/run_stages';
import { editRecipe } from '../../store/case/recipe';
import { schema } from '../../store/run/stages';
import { allowedControls, mayUse } from '../../store/case/keep/lesson_asked';
import { exceeded } from '../../store/run/forecast';
import { choiceWords, fieldUnit, fieldWords, groupWords } from '../controls/field_words';
import { CheckField, NumberField, SelectField } from '../controls/fields';
import { refusal } from '../run/forecast_text';

type StageGroup = 'volume' | 'surface' | 'smooth' | 'remesh' | 'tetra' | 'optimise' | 'quality' | 'limits';

const groups: readonly Exclude<StageGroup, 'limits'>[] = [
  'volume',
  'surface',
  'smooth',
  'remesh',
  'tetra',
  'optimise',
  'quality',
];

const previewed = new Set<StageGroup>(['volume', 'surface', 'smooth']);

/** One field as the engine's table has it: number, flag or choice. */
function StageField(props: { group: StageGroup; title: string; field: SchemaField; current: Recipe }) {
  const { group, title, field, current } = props;
  const { path } = field;
  const name = path.slice(group.length + 1);
  const value = (current[group] as Record<string, unknown>)[name];
  const label = fieldWords(path);
  const set = (next: unknown) => {
    editRecipe(label, (draft) => void ((draft[group] as Record<string, unknown>)[name] = next), path);
    if (previewed.has(group)) previewSoon();
  };
  if (typeof value === 'boolean')
    return <CheckField label={label} checked={value} hint={field.description} onChange={set} />;
  if (typeof value === 'string') {
    const options = (field.values ?? [value]).map((choice) => [choice, choiceWords(path, choice)] as const);
    return (
      <SelectField label={label} value={value} options={options} hint={field.description} onChange={set} />
    );
  }
  return (
    <NumberField
      label={label}
      owner={title}
      unit={fieldUnit(path, field.unit)}
      path={path}
      value={value as number}
      onChange={set}
    />
  );
}

function StageFields({ group, title, current }: { group: StageGroup; title: string; current: Recipe }) {
  return (
    <>
      {schema.value?.fields
        .filter(({ path, type }) => path.startsWith(`${group}.`) && type !== 'list')
        .map((field) => (
          <StageField key={field.path} group={group} title={title} field={field} current={current} />
        ))}
    </>
  );
}

export function StageSection({ current }: { current: Recipe }) {
  const shown = groups.filter(mayUse);
  if (shown.length === 0) return null;
  return (
    <section class="section">
      <details class="more" open={allowedControls.value !== null}>
        <summary>Stage parameters</summary>
        {shown.map((group) => (
          <fieldset key={group} class="stage-fields">
            <legend>{groupWords[group]}</legend>
            <StageFields group={group} title={groupWords[group]} current={current} />
          </fieldset>
        ))}
      </details>
      <details class="more">
        <summary>Limits{exceeded.value.length > 0 && <span class="tag caution">exceeded</span>}</summary>
        <p class="facts">A case that is forecast to take more is not meshed. 0: no limit.</p>
        <StageFields group="limits" title="Limits" current={current} />
        {exceeded.value.map((beyond) => (
          <p key={beyond.field} class="stale">
            {refusal(beyond)}
          </p>
        ))}
      </details>
    </section>
  );
}
