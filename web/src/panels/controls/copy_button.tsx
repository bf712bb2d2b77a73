import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';

/** Puts a text on the clipboard. */
export function CopyButton(props: {
  text: string;
  class?: string;
  label?: string;
  disabled?: boolean;
  children: ComponentChildren;
}) {
  const { text, label } = props;
  const [done, setDone] = useState('');
  const copy = () =>
    navigator.clipboard.writeText(text).then(
      () => setDone('Copied'),
      () => setDone('The browser does not allow copying here; select the text and copy it.'),
    );
  return (
    <>
      <span role="status" class="muted">
        {done}
      </span>
      <button
        type="button"
        class={props.class ?? 'button'}
        aria-label={label}
        title={label}
        disabled={props.disabled}
        onClick={() => void copy()}
      >
        {props.children}
      </button>
    </>
  );
}
