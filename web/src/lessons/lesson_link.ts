/** A lesson as the fragment of a link: `#l1=` + base64url(deflate-raw(canonical JSON)). */
import { canonicalJson } from '../link/canonical';
import { pack, unpack } from '../link/codec';
import type { Lesson } from './lesson';
import { parseLesson } from './read_lesson';

const prefix = '#l1=';

export const encodeLesson = async (lesson: Lesson): Promise<string> =>
  prefix + (await pack(canonicalJson(lesson)));

/** Throws LinkError or LessonError, with a sentence for the reader. */
export const decodeLesson = async (fragment: string): Promise<Lesson> =>
  parseLesson(await unpack(fragment.slice(prefix.length)));

/** The whole address: by its name where the lesson ships with the page, else with the lesson in it. */
export async function lessonAddress(lesson: Lesson, name: string | null): Promise<string> {
  const address = new URL(location.href);
  address.search = name === null ? '' : `lesson=${name}`;
  address.hash = name === null ? await encodeLesson(lesson) : '';
  return address.href;
}
