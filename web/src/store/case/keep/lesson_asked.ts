/** What the page knows of lessons before their code is fetched: which one is asked for, and what it lets be used. */
import { signal } from '@preact/signals';
import { keepText, keptText } from './web_storage';

/** A lesson that ships with the page, by its name; or the text of one, as a link or file brought it. */
export type LessonAsked = (
  | { from: 'page'; name: string }
  | { from: 'link'; fragment: string }
  | { from: 'file'; text: string }
  | { from: 'editor' }
) & {
  /** It was under way in this tab. */
  started?: boolean;
};

export const lessonAsked = signal<LessonAsked | null>(null);

/** Parts of the page that a step of a lesson can leave out. */
export const controlNames = [
  ...(['source', 'labels', 'sizes', 'cuts', 'physics'] as const),
  ...(['volume', 'surface', 'smooth', 'remesh', 'tetra', 'optimise', 'quality'] as const),
  ...(['run', 'evidence', 'export'] as const),
] as const;
export type ControlName = (typeof controlNames)[number];

/** What may be used now; null: everything. */
export const allowedControls = signal<ReadonlySet<ControlName> | null>(null);
export const mayUse = (name: ControlName): boolean => allowedControls.value?.has(name) ?? true;

const openKey = 'voxtet-lesson';

/** The lesson that is open in this tab goes on after a reload. */
export function keepLessonOpen(asked: LessonAsked | null): void {
  keepText('sessionStorage', openKey, asked && JSON.stringify(asked));
}

function keptLesson(): LessonAsked | null {
  const text = keptText('sessionStorage', openKey);
  return text ? (JSON.parse(text) as LessonAsked) : null;
}

export const isLessonFragment = (fragment: string): boolean => fragment.startsWith('#l1=');

/** The lesson of an address: `?lesson=NAME`, or a teacher's own, `#l1=…`. */
export function lessonInAddress({ search, hash }: { search: string; hash: string }): LessonAsked | null {
  if (isLessonFragment(hash)) return { from: 'link', fragment: hash };
  const name = new URLSearchParams(search).get('lesson');
  return name === null ? null : { from: 'page', name };
}

const isSame = (one: LessonAsked, other: LessonAsked | null): boolean =>
  JSON.stringify({ ...one, started: true }) === JSON.stringify({ ...other, started: true });

/** Takes up the lesson of the address, else the one that was open, and those that the user goes to later. */
export function followLessons(): void {
  const inAddress = () => lessonInAddress(location);
  const [asked, kept] = [inAddress(), keptLesson()];
  lessonAsked.value = asked && !isSame(asked, kept) ? asked : kept;
  addEventListener('hashchange', () => {
    if (isLessonFragment(location.hash)) lessonAsked.value = inAddress();
  });
}
