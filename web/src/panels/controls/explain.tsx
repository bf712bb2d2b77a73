import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { announcement } from '../../store/notices';

/** What is explained at present, and beside what. */
const explained = signal<{ text: string; beside: Element } | null>(null);

function explain(text: string, beside: Element): void {
  explained.value = { text, beside };
  announcement.value = text;
}

/** A small (i) that explains what it stands beside, for whoever has no pointer that hovers. */
export function Explain({ of, text }: { of: string; text?: string }) {
  if (!text) return null;
  return (
    <button type="button" class="explain" onClick={(event) => explain(text, event.currentTarget)}>
      <span aria-hidden="true">i</span>
      <span class="sr">What is {of}?</span>
    </button>
  );
}

const restMs = 500;
/** How far a finger may tremble, px. */
const restPx = 8;

/** The next click is none: it is the lifting of a finger that has rested. */
function swallowClick(): void {
  const swallow = (click: Event) => {
    click.preventDefault();
    click.stopPropagation();
  };
  window.addEventListener('click', swallow, { capture: true, once: true });
  const forget = () => window.removeEventListener('click', swallow, { capture: true });
  window.addEventListener('pointerdown', forget, { capture: true, once: true });
}

/** A finger that rests on something with a title is shown it. The next touch, click or Escape closes what is shown. */
function follow(): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let start = [0, 0];
  const lift = () => clearTimeout(timer);
  const listeners: Record<string, (event: PointerEvent & KeyboardEvent) => void> = {
    pointerdown(event) {
      lift();
      explained.value = null;
      const titled = event.target instanceof Element && event.target.closest('[title]');
      const text = titled && titled.getAttribute('title');
      if (event.pointerType !== 'touch' || !text) return;
      start = [event.clientX, event.clientY];
      timer = setTimeout(() => {
        explain(text, titled);
        swallowClick();
      }, restMs);
    },
    pointermove(event) {
      if (Math.hypot(event.clientX - start[0], event.clientY - start[1]) > restPx) lift();
    },
    pointerup: lift,
    pointercancel: lift,
    keydown(event) {
      if (event.key !== 'Escape' || !explained.value) return;
      explained.value = null;
      event.stopPropagation();
    },
  };
  const all = Object.entries(listeners) as [string, EventListener][];
  for (const [name, listener] of all) window.addEventListener(name, listener, { capture: true });
  return () => {
    lift();
    for (const [name, listener] of all) window.removeEventListener(name, listener, { capture: true });
  };
}

/** The explanation that was asked for, above everything. */
export function Explanation() {
  const bubble = useRef<HTMLDivElement>(null);
  const now = explained.value;
  useEffect(follow, []);
  useEffect(() => {
    const element = bubble.current;
    if (!element || !now) return;
    element.showPopover();
    const scale = element.currentCSSZoom ?? 1;
    const place = now.beside.getBoundingClientRect();
    const { width, height } = element.getBoundingClientRect();
    const { clientWidth, clientHeight } = document.documentElement;
    const left = Math.max(8, Math.min(place.left, clientWidth - width - 8));
    const below = place.bottom + 6;
    const top = below + height < clientHeight ? below : Math.max(8, place.top - height - 6);
    element.style.left = `${left / scale}px`;
    element.style.top = `${top / scale}px`;
    return () => element.hidePopover();
  }, [now]);
  return (
    <div ref={bubble} class="explanation" popover="manual" role="note">
      {now?.text}
    </div>
  );
}
