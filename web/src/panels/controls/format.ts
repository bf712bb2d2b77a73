export const whole = (value: number): string => Math.round(value).toLocaleString('en');

/** Four significant digits at most, without needless zeros, with a minus sign. */
export function short(value: number): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const digits = size >= 1000 ? whole(size) : String(Number(size.toPrecision(size >= 100 ? 4 : 3)));
  return value < 0 ? `−${digits}` : digits;
}

/** Never broken between number and unit where it is short. */
export function seconds(value: number): string {
  if (value < 0.0995) return `${Math.max(1, Math.round(value * 1000))}\u00a0ms`;
  if (value < 59.95) return `${value.toFixed(1)}\u00a0s`;
  const all = Math.round(value);
  if (all >= 3600) return `${Math.floor(all / 3600)} h ${Math.floor((all % 3600) / 60)} min`;
  return `${Math.floor(all / 60)} min ${all % 60} s`;
}

/** About a count: two digits, thousands and millions named. */
export function about(value: number): string {
  const two = Number(value.toPrecision(2));
  if (two >= 1e6) return `${two / 1e6} million`;
  return two.toLocaleString('en');
}

const unitSigns: Record<string, string> = { deg: '°', '1': '', log2: 'log₂' };

export function unitSign(unit: string): string {
  return unitSigns[unit] ?? unit;
}

/** A field's name as words without its unit: `min_dihedral_deg` becomes "Min dihedral". */
export function sentence(name: string): string {
  return (name.charAt(0).toUpperCase() + name.slice(1)).replace(/_(deg|mm|log2)$/, '').replaceAll('_', ' ');
}

/** Beyond so many characters some chat programs cut a link. */
export const longLink = 2000;

/** What to expect of a link of so many characters; `what` may be sent as a file instead. */
export function lengthNote(length: number, what: 'case' | 'lesson'): string {
  if (length > 500_000) return `Too long for a link: send the ${what} file instead.`;
  if (length > 8000)
    return `Long for a link: mail and chat programs will cut it. Better send the ${what} file.`;
  if (length > longLink) return 'Some chat programs cut links of this length.';
  return '';
}
