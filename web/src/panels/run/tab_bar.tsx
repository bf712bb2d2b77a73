import { pageTab, pageTabs, type PageTab } from '../controls/page_shape';
import { RunButton } from './run_button';

const titles: Record<PageTab, string> = {
  lesson: 'Lesson',
  case: 'Case',
  view: 'View',
  evidence: 'Evidence',
};

/** Which tab a key leads to. */
function tabFor(key: string): PageTab | undefined {
  const tabs = pageTabs.value;
  const now = tabs.indexOf(pageTab.value);
  const last = tabs.length - 1;
  const next = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: last }[key];
  return next === undefined ? undefined : tabs.at(next > last ? 0 : next);
}

/** Where there is room for one part of the page: which one, and Run in reach of a thumb. */
export function TabBar() {
  const onKey = (event: KeyboardEvent) => {
    const next = tabFor(event.key);
    if (!next) return;
    event.preventDefault();
    pageTab.value = next;
    document.getElementById(`tab-${next}`)?.focus();
  };
  return (
    <div class="tab-bar">
      <div class="tabs" role="tablist" aria-label="Parts of the page" onKeyDown={onKey}>
        {pageTabs.value.map((name) => (
          <button
            type="button"
            role="tab"
            key={name}
            id={`tab-${name}`}
            aria-selected={pageTab.value === name}
            aria-controls={`part-${name}`}
            tabIndex={pageTab.value === name ? 0 : -1}
            onClick={() => (pageTab.value = name)}
          >
            {titles[name]}
          </button>
        ))}
      </div>
      <RunButton />
    </div>
  );
}
