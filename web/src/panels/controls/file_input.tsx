import type { ComponentChildren } from 'preact';
import { useRef } from 'preact/hooks';

/** A button that lets one choose files. */
export function FileInput(props: {
  class: string;
  title?: string;
  testId: string;
  onFiles(files: File[]): void;
  children: ComponentChildren;
}) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button type="button" class={props.class} title={props.title} onClick={() => input.current?.click()}>
        {props.children}
      </button>
      <input
        ref={input}
        type="file"
        multiple
        hidden
        aria-hidden="true"
        tabIndex={-1}
        data-testid={props.testId}
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = '';
          props.onFiles(files);
        }}
      />
    </>
  );
}
