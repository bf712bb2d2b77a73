/** What a page and the app embedded in it say to each other, by postMessage. Whatever comes in is untrusted. */
import type { ErrorCode } from '../engine/contract';
import type { VerdictKind } from './verdict';

/** A change of these messages that an older page would not understand has another number. */
export const embedVersion = 1;

const directions = ['R', 'L', 'A', 'P', 'S', 'I'] as const;

/** How the mesh is shown; what is left out stays as it is. */
export interface EmbedView {
  /** `label`, or the name of a measure or of what a simulation found. */
  colour?: string;
  edges?: boolean;
  /** A plane by its normal, RAS, and its place: 0 and 1 are the ends of the body. `flat`: through the elements. */
  cut?: false | { normal: [number, number, number]; place: number; flat?: boolean };
  /** The camera looks from the patient's right, left, front, back, head or feet. */
  look?: (typeof directions)[number];
}

/** From the page to the app. */
export type EmbedRequest =
  /** A recipe, or a link with one. It is checked and shown; nothing runs. */
  | { type: 'voxtet:open'; case: object | string }
  | { type: 'voxtet:run' }
  | ({ type: 'voxtet:view' } & EmbedView);

/** From the app to the page. */
export type EmbedEvent =
  | { type: 'voxtet:ready'; version: typeof embedVersion; engine: string }
  | { type: 'voxtet:progress'; stage: string; fraction: number }
  | {
      type: 'voxtet:done';
      report: { engine: string; digest: string; tets: number; points: number; passed: boolean };
      /** What the case promised against what came; null where it promised nothing. */
      verdict: VerdictKind | null;
    }
  | { type: 'voxtet:error'; code: ErrorCode; stage: string; message: string };

/** A message that is meant for the app and is none of those that it takes. */
export class MessageError extends Error {
  override readonly name = 'MessageError';
}

const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);

function expectThat(holds: boolean, field: string, expected: string): void {
  if (!holds) throw new MessageError(`voxtet:view: ${field}: expected ${expected}`);
}

function readView(data: Record<string, unknown>): EmbedView {
  const { colour, edges, cut, look } = data;
  expectThat(colour === undefined || (typeof colour === 'string' && colour.length < 100), 'colour', 'a name');
  expectThat(edges === undefined || typeof edges === 'boolean', 'edges', 'true or false');
  const known = look === undefined || directions.includes(look as 'R');
  expectThat(known, 'look', `one of ${directions.join(' ')}`);
  if (cut !== undefined && cut !== false) {
    const { normal, place, flat } = (cut ?? {}) as Record<string, unknown>;
    const isVector = Array.isArray(normal) && normal.length === 3 && normal.every(isNumber);
    expectThat(isVector && Math.hypot(...normal) > 0, 'cut.normal', 'three numbers that are not all 0');
    expectThat(isNumber(place) && place >= 0 && place <= 1, 'cut.place', 'a number from 0 to 1');
    expectThat(flat === undefined || typeof flat === 'boolean', 'cut.flat', 'true or false');
  }
  return { colour, edges, cut, look } as EmbedView;
}

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
      if (typeof given !== 'string' && (typeof given !== 'object' || given === null))
        throw new MessageError('voxtet:open: case: expected a recipe, or a link with one');
      return { type, case: given };
    }
    case 'voxtet:run':
      return { type };
    case 'voxtet:view':
      return { type, ...readView(message) };
    default:
      throw new MessageError(`${type.slice(0, 60)}: expected voxtet:open, voxtet:run or voxtet:view`);
  }
}
