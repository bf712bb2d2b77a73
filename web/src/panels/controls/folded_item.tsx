import type { ComponentChildren } from 'preact';
import { Icon } from './icons';

/** Takes a thing out of a list. */
export function RemoveButton({ what, onRemove }: { what: string; onRemove(): void }) {
  const name = `Remove ${what}`;
  return (
    <button type="button" class="icon-button small" aria-label={name} title="Remove" onClick={onRemove}>
      <Icon name="trash" size={14} />
    </button>
  );
}

/** One thing of a list: its name and what it asks for; its fields while it is open. */
export function FoldedItem(props: {
  name: string;
  note: string;
  open: boolean;
  onToggle(): void;
  onRemove(): void;
  children?: ComponentChildren;
}) {
  const { name, note, open } = props;
  return (
    <div class={open ? 'region open' : 'region'}>
      <div class="region-head">
        <button type="button" class="region-name" aria-expanded={open} onClick={props.onToggle}>
          <span class="region-title" title={name}>
            {name}
          </span>
          <span class="region-edge">{note}</span>
        </button>
        <RemoveButton what={name} onRemove={props.onRemove} />
      </div>
      {open && <div class="region-fields">{props.children}</div>}
    </div>
  );
}
