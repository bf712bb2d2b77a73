/**
 * The recipe as the fragment of a link: `#c1=` + base64url(deflate-raw(canonical JSON)), or `#j=` + plain JSON.
 * Whatever comes in is untrusted: its size, depth and number of regions are bounded here, its fields by the engine.
 */
import { canonicalJson } from './canonical';

export const maxInflatedBytes = 1 << 20;
export const maxDepth = 12;
export const maxRegions = 256;

export class LinkError extends Error {
  override readonly name = 'LinkError';
}

/** A text as base64url(deflate-raw(text)). */
export async function pack(text: string): Promise<string> {
  const bytes = new TextEncoder().encode(text);
  return toBase64Url(await collect(through(bytes, new CompressionStream('deflate-raw')), Infinity));
}

/** The text that was packed, of bounded size. Throws LinkError. */
export async function unpack(packed: string): Promise<string> {
  const bytes = fromBase64Url(packed);
  try {
    return decodeUtf8(
      await collect(through(bytes, new DecompressionStream('deflate-raw')), maxInflatedBytes),
    );
  } catch (error) {
    if (error instanceof LinkError) throw error;
    throw new LinkError('The link is cut short or damaged: its compressed part does not end.');
  }
}

export async function encodeFragment(minimal: Record<string, unknown>): Promise<string> {
  return `#c1=${await pack(canonicalJson(minimal))}`;
}

export function encodePlainFragment(minimal: Record<string, unknown>): string {
  return `#j=${encodeURIComponent(canonicalJson(minimal))}`;
}

export function isCaseFragment(fragment: string): boolean {
  return fragment.startsWith('#c1=') || fragment.startsWith('#j=');
}

/** The JSON object of a fragment. Throws LinkError, with a sentence for the reader. */
export async function decodeFragment(fragment: string): Promise<Record<string, unknown>> {
  if (fragment.startsWith('#c1=')) return parseCase(await unpack(fragment.slice(4)));
  if (fragment.startsWith('#j=')) {
    if (fragment.length > maxInflatedBytes) throw new LinkError('The link holds more than 1 MB.');
    let text: string;
    try {
      text = decodeURIComponent(fragment.slice(3));
    } catch {
      throw new LinkError('The link holds a broken percent code.');
    }
    return parseCase(text);
  }
  throw new LinkError('The link holds no case: its fragment starts with neither #c1= nor #j=.');
}

/**
 * JSON of a value that came as an object, within the bounds. What one object holds twice counts twice: parts that hold
 * one another twofold would else be written out without end.
 */
export function jsonWithin(value: unknown): string {
  let left = maxInflatedBytes;
  const count = (part: unknown, depth: number): void => {
    left -= typeof part === 'string' ? part.length : 1;
    if (left < 0) throw new LinkError('The case holds more than 1 MB.');
    if (part === null || typeof part !== 'object') return;
    if (depth === 0) throw new LinkError(`The case nests deeper than ${maxDepth} levels.`);
    for (const [key, entry] of Object.entries(part)) {
      left -= key.length;
      count(entry, depth - 1);
    }
  };
  count(value, maxDepth);
  return JSON.stringify(value);
}

/** A case from JSON text: an object within the bounds. */
export function parseCase(text: string): Record<string, unknown> {
  if (text.length > maxInflatedBytes) throw new LinkError('The case holds more than 1 MB.');
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new LinkError('The case is no JSON: it is cut short or damaged.');
  }
  if (value === null || typeof value !== 'object' || Array.isArray(value)) {
    throw new LinkError('The case is no JSON object of recipe fields.');
  }
  if (depthExceeds(value, maxDepth)) throw new LinkError(`The case nests deeper than ${maxDepth} levels.`);
  const sizing = (value as { sizing?: { regions?: unknown } }).sizing;
  if (Array.isArray(sizing?.regions) && sizing.regions.length > maxRegions) {
    throw new LinkError(
      `The case holds ${sizing.regions.length} regions; at most ${maxRegions} are accepted.`,
    );
  }
  return value as Record<string, unknown>;
}

export function depthExceeds(value: unknown, left: number): boolean {
  if (value === null || typeof value !== 'object') return false;
  return left === 0 || Object.values(value).some((entry) => depthExceeds(entry, left - 1));
}

function decodeUtf8(bytes: Uint8Array): string {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    throw new LinkError('The link holds text that is not UTF-8.');
  }
}

function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream) {
  return new Blob([bytes]).stream().pipeThrough(stream) as ReadableStream<Uint8Array>;
}

async function collect(stream: ReadableStream<Uint8Array>, limit: number): Promise<Uint8Array<ArrayBuffer>> {
  const chunks: Uint8Array[] = [];
  let size = 0;
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > limit) {
      void reader.cancel().catch(() => undefined);
      throw new LinkError('The link inflates to more than 1 MB.');
    }
    chunks.push(value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const chunk of chunks) {
    all.set(chunk, at);
    at += chunk.length;
  }
  return all;
}

function toBase64Url(bytes: Uint8Array): string {
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  if (!/^[\w-]*$/.test(text)) throw new LinkError('The link holds characters that base64url does not.');
  try {
    return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
  } catch {
    throw new LinkError('The link is cut short or damaged.');
  }
}
