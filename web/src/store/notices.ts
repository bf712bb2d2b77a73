/** What the user is told: sentences on the page, and those that are read aloud. */
import { signal } from '@preact/signals';
import type { EngineError } from '../engine/contract';
import { showPlace } from './view';

/** A sentence for the user: a failure to act on, or news. */
export interface Notice {
  id: number;
  tone: 'error' | 'news';
  title: string;
  text: string;
  /** What can be done about it. */
  way?: Way;
  /** The engine's error that it tells of. */
  error?: EngineError;
}

export interface Way {
  name: string;
  go(): void;
}

export const notices = signal<Notice[]>([]);
/** Read aloud, and not shown. */
export const announcement = signal('');

let noticeCount = 0;

export function tell(
  tone: Notice['tone'],
  title: string,
  text: string,
  way?: Way,
  error?: EngineError,
): void {
  const notice = { id: ++noticeCount, tone, title, text, way, error };
  // One error at a time: what was followed by another one is no longer what there is to act on.
  const stays = (old: Notice) =>
    tone === 'error' ? old.tone !== 'error' : old.title !== title || old.text !== text;
  notices.value = [...notices.value.filter(stays), notice];
  // What can be acted on waits for that.
  if (tone === 'news' && !way) setTimeout(() => dismiss(notice.id), 6000);
}

export function dismiss(id: number): void {
  notices.value = notices.value.filter((notice) => notice.id !== id);
}

/** What was asked for anew makes what went wrong before a thing of the past. */
export function dismissErrors(): void {
  notices.value = notices.value.filter(({ tone }) => tone !== 'error');
}

const errorTitles: Record<EngineError['code'], string> = {
  usage: 'These settings cannot be used',
  bad_input: 'This file cannot be read',
  meshing: 'Meshing did not succeed',
  differs: 'This is not the expected file',
  out_of_memory: 'Out of memory',
  cancelled: 'Cancelled',
  internal: 'The engine stopped',
};

export function tellFailure(error: EngineError): void {
  const { where } = error;
  const hasPlace = where.points.length > 0;
  const way = hasPlace ? { name: 'Show where', go: () => showPlace(where) } : undefined;
  tell('error', errorTitles[error.code], error.message, way, error);
  if (hasPlace) showPlace(where);
}
