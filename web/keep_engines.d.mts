export function keepEngines(oldDist: string, newDist: string): string[];
