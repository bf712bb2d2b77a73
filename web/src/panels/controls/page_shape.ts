/** How the page is laid out: by its size, and by that of its type. */
import { computed, effect, signal } from '@preact/signals';
import { lessonAsked } from '../../store/case/keep/lesson_asked';
import { caseId, hasSource, recipe } from '../../store/case/recipe';
import { studyShown } from '../../store/study/study';
import { largeType, marked } from '../../store/view';

/** What large type multiplies all lengths of the page by; `--type` in the styles. */
const largeScale = 1.3;

const size = signal({ width: 1280, height: 800 });

/** Three columns, or three close ones; else tabs, with the view in sight above them or as one of them. */
export type PageShape = 'wide' | 'close' | 'tablet' | 'phone';

export const pageShape = computed((): PageShape => {
  const scale = largeType.value ? largeScale : 1;
  const [width, height] = [size.value.width / scale, size.value.height / scale];
  if (width >= 900) return width > 1100 ? 'wide' : 'close';
  return width >= 620 && height >= 900 ? 'tablet' : 'phone';
});

export const tabbed = computed(() => pageShape.value === 'tablet' || pageShape.value === 'phone');

export type PageTab = 'lesson' | 'case' | 'view' | 'evidence';

/** A lesson has a tab while one is open. */
export const pageTabs = computed((): readonly PageTab[] => [
  ...(lessonAsked.value ? (['lesson'] as const) : []),
  ...(['case', 'view', 'evidence'] as const),
]);

/** Which part is in front where there is room for one. */
export const pageTab = signal<PageTab>('view');

/** What the user has asked to see in the view is in the view. */
export function showView(): void {
  if (pageShape.value === 'phone') pageTab.value = 'view';
}

export function followPageSize(): void {
  const read = () => {
    const { clientWidth: width, clientHeight: height } = document.documentElement;
    size.value = { width, height };
  };
  read();
  window.addEventListener('resize', read);
  effect(() => {
    if (marked.value) showView();
  });
  effect(() => {
    if (lessonAsked.value) pageTab.value = 'lesson';
    else if (pageTab.peek() === 'lesson') pageTab.value = 'view';
  });
  // Another case, or a lesson, comes before the study; the empty page that the app begins with is no case.
  const casePresent = computed(() => (recipe.value && hasSource(recipe.value) ? caseId.value : ''));
  effect(() => {
    void [casePresent.value, lessonAsked.value];
    studyShown.value = false;
  });
}
