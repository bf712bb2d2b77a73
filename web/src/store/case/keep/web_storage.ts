/** Short texts that the browser keeps. One that keeps none, or is full, is no reason to fail. */
type Area = 'localStorage' | 'sessionStorage';

export function keptText(area: Area, key: string): string | null {
  try {
    return globalThis[area].getItem(key);
  } catch {
    return null;
  }
}

export function keepText(area: Area, key: string, text: string | null): void {
  try {
    if (text === null) globalThis[area].removeItem(key);
    else globalThis[area].setItem(key, text);
  } catch {
    // Nobody is to be told.
  }
}
