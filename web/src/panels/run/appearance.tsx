import { dark, largeType, theme, type ThemeChoice } from '../../store/view';
import { CheckField, Segments } from '../controls/fields';
import { Icon } from '../controls/icons';

const themes: readonly (readonly [ThemeChoice, string, string?])[] = [
  ['system', 'System', 'As this computer has it'],
  ['light', 'Light'],
  ['dark', 'Dark'],
];

/** How the page looks: theme, size of its type. */
export function Appearance() {
  return (
    <>
      <button
        type="button"
        class="icon-button"
        aria-label="Appearance"
        title="Theme, large type"
        popovertarget="appearance"
      >
        <Icon name={dark.value ? 'moon' : 'sun'} />
      </button>
      <div id="appearance" class="menu" popover="auto" role="dialog" aria-label="Appearance">
        <Segments
          label="Theme"
          value={theme.value}
          options={themes}
          onChange={(next) => (theme.value = next)}
        />
        <CheckField
          label="Large type, for projectors"
          checked={largeType.value}
          onChange={(on) => (largeType.value = on)}
        />
      </div>
    </>
  );
}
