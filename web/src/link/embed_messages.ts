/** What a page and the app embedded in it say to each other, by postMessage. Whatever comes in is untrusted. */
import type { ErrorCode } from '../engine/contract';
import type { Verdict } from './verdict';

/** A change of these messages that an older page would not understand has another number. */
export const embedVersion = 1;

/** From the page to the app. */
export type EmbedRequest =
  /** A recipe, or a link with one. It is checked and shown; nothing runs. */
  | { type: 'voxtet:open'; case: object | string }
  | { type: 'voxtet:run' }
  /** How it is shown: the `view` of a recipe. */
  | { type: 'voxtet:view'; view: object };

/** From the app to the page. */
export type EmbedEvent =
  | { type: 'voxtet:ready'; version: typeof embedVersion; engine: string }
  | { type: 'voxtet:progress'; stage: string; fraction: number }
  | {
      type: 'voxtet:done';
      report: { engine: string; digest: string; tets: number; points: number; passed: boolean };
      /** What the case promised against what came; null where it promised nothing. */
      verdict: Pick<Verdict, 'mesh' | 'simulation'> | null;
    }
  | { type: 'voxtet:error'; code: ErrorCode; stage: string; message: string };

/** A message that is meant for the app and is none of those that it takes. */
export class MessageError extends Error {
  override readonly name = 'MessageError';
}

const isObject = (value: unknown): value is object => typeof value === 'object' && value !== null;

/** The request of a message; null where it is not meant for the app. Throws MessageError where it cannot be read. */
export function readRequest(data: unknown): EmbedRequest | null {
  const { type, version = embedVersion } = (data ?? {}) as Record<string, unknown>;
  if (typeof type !== 'string' || !type.startsWith('voxtet:')) return null;
  if (version !== embedVersion)
    throw new MessageError(`${type}: version: expected ${embedVersion}, the only one that is known here`);
  const message = data as Record<string, unknown>;
  switch (type) {
    case 'voxtet:open': {
      const given = message.case;
      if (typeof given !== 'string' && !isObject(given))
        throw new MessageError('voxtet:open: case: expected a recipe, or a link with one');
      return { type, case: given };
    }
    case 'voxtet:run':
      return { type };
    case 'voxtet:view':
      if (!isObject(message.view)) throw new MessageError('voxtet:view: view: expected that of a recipe');
      return { type, view: message.view };
    default:
      throw new MessageError(`${type.slice(0, 60)}: expected voxtet:open, voxtet:run or voxtet:view`);
  }
}
