import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { Icon } from './icons';

export function Dialog(props: {
  title: string;
  class?: string;
  onClose(): void;
  children: ComponentChildren;
}) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const dialog = element.current;
    if (dialog && !dialog.open) dialog.showModal();
    // Not its first button, which closes it.
    dialog?.focus();
    return () => dialog?.close();
  }, []);
  return (
    <dialog ref={element} class={props.class} tabIndex={-1} aria-label={props.title} onCancel={props.onClose}>
      <div class="dialog-head">
        <h2>{props.title}</h2>
        <button type="button" class="icon-button" aria-label="Close" onClick={props.onClose}>
          <Icon name="cross" />
        </button>
      </div>
      {props.children}
    </dialog>
  );
}
