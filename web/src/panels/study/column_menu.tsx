import type { Study, StudyColumn } from '../../store/study/read_study';
import { CheckField } from '../controls/fields';
import { Icon } from '../controls/icons';
import { columnTitle } from './column_words';

const kinds: readonly (readonly [StudyColumn['kind'], string])[] = [
  ['given', 'What was given'],
  ['found', 'What was found'],
  ['cost', 'What it cost'],
];

/** Which columns the table has, beside name and status. */
export function ColumnMenu(props: {
  of: Study;
  shown: ReadonlySet<string>;
  onChange(shown: ReadonlySet<string>): void;
}) {
  const { of, shown, onChange } = props;
  const set = (name: string, on: boolean) =>
    onChange(new Set(on ? [...shown, name] : [...shown].filter((one) => one !== name)));
  return (
    <>
      <button type="button" class="button small column-button" popovertarget="study-columns">
        <Icon name="columns" size={14} /> Columns
      </button>
      <div id="study-columns" class="menu column-menu" popover="auto" role="dialog" aria-label="Columns">
        {kinds.map(([kind, title]) => {
          const columns = of.columns.filter((column) => column.kind === kind);
          return (
            columns.length > 0 && (
              <fieldset key={kind}>
                <legend>{title}</legend>
                {columns.map(({ name }) => (
                  <CheckField
                    key={name}
                    label={columnTitle(name)}
                    checked={shown.has(name)}
                    onChange={(on) => set(name, on)}
                  />
                ))}
              </fieldset>
            )
          );
        })}
      </div>
    </>
  );
}
