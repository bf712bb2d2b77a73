/** Files at an address: what may be asked for, and what came of it. Nothing is fetched before the user says so. */
import { signal } from '@preact/signals';

/** What a file can be fetched for; each is a parameter of the page's address. */
export const remoteKinds = ['case', 'volume', 'study'] as const;

export interface RemoteFile {
  kind: (typeof remoteKinds)[number];
  url: string;
  /** What the file is to be called; else as its address ends. */
  name?: string;
}

export const remoteAsked = signal<RemoteFile | null>(null);

/** A file larger than that does not fit beside its mesh. */
export const mostBytes = 1_000_000_000;

const privateHost =
  /^(localhost|.*\.localhost|.*\.local|.*\.internal|\[.*\]|\d+(\.\d+){0,3}|0x[0-9a-f.x]+)$/i;

/** Why nothing is fetched from an address; empty where it may be, from this page. */
export function addressFault(text: string, page: string): string {
  let url: URL;
  try {
    url = new URL(text, page);
  } catch {
    return `${text} is no address.`;
  }
  if (url.username || url.password) return 'The address holds a user name or a password. Leave them out.';
  if (url.origin === new URL(page).origin) return '';
  if (url.protocol !== 'https:') return `The address begins with ${url.protocol}//, expected https://.`;
  if (privateHost.test(url.hostname))
    return `${url.hostname} is within a network, or no name at all: expected a public host.`;
  return '';
}

/** The file that the page's own address asks for: ?case=https://…, ?volume=https://… or ?study=https://… */
export function remoteInAddress(search: string): RemoteFile | null {
  const given = new URLSearchParams(search);
  for (const kind of remoteKinds) {
    const url = given.get(kind);
    if (url) return { kind, url };
  }
  return null;
}

/** Why a fetch failed, and what the host can do. */
export class RemoteError extends Error {}

const megabytes = (bytes: number) => `${(bytes / 1e6).toLocaleString('en', { maximumFractionDigits: 1 })} MB`;

/** Fetches a file, and counts its bytes on the way. Without credentials, and from no other page than it says. */
export async function fetchRemote(
  asked: RemoteFile,
  page: string,
  onBytes: (count: number, total: number | null) => void,
  signal: AbortSignal,
): Promise<File> {
  const fault = addressFault(asked.url, page);
  if (fault) throw new RemoteError(fault);
  const url = new URL(asked.url, page);
  let answer: Response;
  try {
    answer = await fetch(url, {
      credentials: 'omit',
      referrerPolicy: 'no-referrer',
      redirect: 'follow',
      signal,
    });
  } catch (error) {
    if (signal.aborted) throw error;
    throw new RemoteError(
      `${url.host} could not be reached, or does not let other pages read its files (CORS). Its owner can allow it ` +
        'by the header Access-Control-Allow-Origin: *. Else download the file and drop it here.',
    );
  }
  if (!answer.ok)
    throw new RemoteError(
      `${url.host} answers ${answer.status}${answer.status === 404 ? ': there is no such file' : ''}.`,
    );
  const redirected = addressFault(answer.url || url.href, page);
  if (redirected) throw new RemoteError(`${url.host} sends on to another address. ${redirected}`);
  const told = Number(answer.headers.get('Content-Length')) || null;
  if (told && told > mostBytes)
    throw new RemoteError(`The file has ${megabytes(told)}, more than ${megabytes(mostBytes)}.`);
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let count = 0;
  const reader = answer.body?.getReader();
  for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
    parts.push(part.value);
    count += part.value.length;
    if (count > mostBytes) {
      await reader?.cancel();
      throw new RemoteError(`The file has more than ${megabytes(mostBytes)}.`);
    }
    onBytes(count, told);
  }
  const name = asked.name ?? (decodeURIComponent(url.pathname.split('/').at(-1) ?? '') || 'volume');
  return new File(parts, name);
}
