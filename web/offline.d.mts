export function writeServiceWorker(folder: string): Promise<string[]>;
