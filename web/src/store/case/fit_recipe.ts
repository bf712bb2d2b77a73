/** Parts of a recipe whose content the engine alone knows: kept whole. */
const whole = new Set(['source', 'expected', 'physics']);

const kindOf = (value: unknown): string => (Array.isArray(value) ? 'list' : typeof value);

/** What of a saved recipe still has a place among the engine's fields, and the paths of what has none. */
export function fitRecipe(saved: object, defaults: object): { fitted: object; left: string[] } {
  const left: string[] = [];
  const fit = (value: object, known: object, path: string): object => {
    const places = new Map(Object.entries(known));
    const entries = Object.entries(value).flatMap(([name, part]): [string, unknown][] => {
      const own = path + name;
      if (path === '' && whole.has(name)) return [[name, part]];
      const place = places.get(name);
      if (place === undefined || kindOf(part) !== kindOf(place)) {
        left.push(own);
        return [];
      }
      return [[name, kindOf(place) === 'object' ? fit(part as object, place, `${own}.`) : part]];
    });
    return Object.fromEntries(entries);
  };
  return { fitted: fit(saved, defaults, ''), left };
}
