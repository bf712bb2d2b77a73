/** Runs the program of verification, and tells what it prints. */
import type { Message } from './checks';

type Create = (options: {
  arguments: string[];
  print: (line: string) => void;
  printErr: (line: string) => void;
}) => Promise<unknown>;

const tell = (message: Message) => postMessage(message);

self.onmessage = async ({ data }: MessageEvent<string>) => {
  try {
    const { default: create } = (await import(/* @vite-ignore */ data)) as { default: Create };
    let told = '';
    await create({
      arguments: ['checks'],
      print: (line) => line && tell({ line }),
      printErr: (line) => {
        told = line;
      },
    });
    tell(told ? { failed: told } : { done: true });
  } catch (error) {
    tell({ failed: error instanceof Error ? error.message : String(error) });
  }
};
