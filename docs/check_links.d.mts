export function deadLinks(root: string, folder: string): string[];
