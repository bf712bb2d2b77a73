import type { ZipOrder } from './zip_worker';

type Files = Record<string, Uint8Array<ArrayBuffer>>;

function ordered<T>(order: ZipOrder): Promise<T> {
  const worker = new Worker(new URL('./zip_worker.ts', import.meta.url), { type: 'module' });
  return new Promise<T>((done, failed) => {
    worker.onmessage = ({ data }: MessageEvent<{ done: T } | { trouble: string }>) =>
      'done' in data ? done(data.done) : failed(new Error(data.trouble));
    worker.onerror = (event) => failed(new Error(event.message || 'The zip worker could not be started.'));
    worker.postMessage(order);
  }).finally(() => worker.terminate());
}

export const packZip = (files: Files) => ordered<Uint8Array<ArrayBuffer>>({ pack: files });
export const unpackZip = (bytes: Uint8Array) => ordered<Files>({ unpack: bytes });
