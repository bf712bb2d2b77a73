import type { ComponentChildren } from 'preact';
import { tabbed, type PageTab } from './page_shape';

/** A column of the page, or what a tab shows. */
export function Panel(props: {
  part: PageTab;
  class: string;
  label: string;
  busy?: boolean;
  children?: ComponentChildren;
}) {
  return (
    <section
      class={`panel ${props.class}`}
      id={`part-${props.part}`}
      role={tabbed.value ? 'tabpanel' : undefined}
      aria-label={props.label}
      aria-busy={props.busy}
    >
      {props.children}
    </section>
  );
}
