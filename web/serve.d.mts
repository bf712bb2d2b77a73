import type { Server } from 'node:http';

export function fileOf(root: string, requestUrl: string): string | null;
export function encodingsFor(accepted?: string): string[];
export function serve(options: { root: string; port: number }): Promise<Server>;
export const sampleCase: object;
