/** The page that embeds the app: the one that may speak to it, and that hears what it does. */
import type { EmbedEvent } from '../../link/embed_messages';

/** `?embed=https://course.example` speaks to no other page than one of this origin, `?embed` to any that embeds it. */
const wanted = new URLSearchParams(globalThis.location?.search).get('embed') ?? '';

export const isHost = ({ source, origin }: MessageEvent): boolean =>
  parent !== window && source === parent && (wanted === '' || origin === wanted);

/** Not every browser tells who embeds a page; those that do not just let nobody else hear. */
const isStranger = () => wanted !== '' && (location.ancestorOrigins?.[0] ?? wanted) !== wanted;

export function tellHost(event: EmbedEvent): void {
  if (parent === window || isStranger()) return;
  try {
    parent.postMessage(event, wanted || '*');
  } catch {
    // What stands in the address is no origin: nobody is spoken to.
  }
}
