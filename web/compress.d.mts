export function compressFolder(folder: string): Promise<{ plain: number; br: number; gz: number }>;
