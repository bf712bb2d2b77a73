/** Packs and unpacks zips beside the main thread. */
import { unzipSync, zipSync, type Zippable } from 'fflate';

export type ZipOrder = { pack: Zippable } | { unpack: Uint8Array };

onmessage = ({ data }: MessageEvent<ZipOrder>) => {
  try {
    const done = 'pack' in data ? zipSync(data.pack) : unzipSync(data.unpack);
    postMessage({ done });
  } catch (error) {
    postMessage({ trouble: error instanceof Error ? error.message : String(error) });
  }
};
