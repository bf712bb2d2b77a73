import type { Server } from 'node:http';

export function fileOf(root: string, requestUrl: string, base?: string): string | null;
export function encodingsFor(accepted?: string): string[];
export function serve(options: {
  root: string;
  port: number;
  /** The path that the app lies under. */
  base?: string;
  /** Without any header that a host need not send. */
  plain?: boolean;
}): Promise<Server>;
export const sampleCase: object;
