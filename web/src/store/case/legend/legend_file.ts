/** Tables of names and colours: label descriptions of ITK-SNAP, colour tables of 3D Slicer and FreeSurfer. */
import { tell } from '../../notices';
import { tellError } from '../../run/engine';
import { volume } from '../input';
import { editLegend, type LegendEntry } from './legend';

// Number, red, green, blue, opacity, two switches, "name".
const snapLine = /^(\d+)\s+(\d+)\s+(\d+)\s+(\d+)\s+[\d.]+\s+\d\s+\d\s+"(.*)"$/;
// Number, name, red, green, blue, and opacity where it is given.
const tableLine = /^(\d+)\s+(\S+)\s+(\d+)\s+(\d+)\s+(\d+)(?:\s+\d+)?$/;

function entryOf(line: string): LegendEntry | null {
  const snap = snapLine.exec(line);
  const table = snap ? null : tableLine.exec(line);
  const [number, name, ...parts] = snap
    ? [snap[1], snap[5], snap[2], snap[3], snap[4]]
    : table
      ? table.slice(1, 6)
      : [];
  const colour = parts.map(Number);
  if (!name || Number(number) > 65535 || colour.some((part) => part > 255)) return null;
  return {
    label: Number(number),
    name,
    colour: `#${colour.map((part) => part.toString(16).padStart(2, '0')).join('')}`,
  };
}

/** The entries of a table, background left out. Throws where a line is none, and says which. */
export function readLegend(file: string, text: string): LegendEntry[] {
  const found = new Map<number, LegendEntry>();
  text.split(/\r?\n/).forEach((line, i) => {
    const written = line.trim();
    if (!written || written.startsWith('#')) return;
    const entry = entryOf(written);
    if (!entry)
      throw new Error(
        `${file}, line ${i + 1}: found "${written.slice(0, 60)}", expected a label with its name and colour from 0 to 255, ` +
          'as 5 scar 200 50 50 0 (3D Slicer, FreeSurfer) or 5 200 50 50 1 1 1 "scar" (ITK-SNAP)',
      );
    if (entry.label > 0) found.set(entry.label, entry);
  });
  return [...found.values()];
}

/** Takes what a table says of the labels that the case has. */
export async function openLegendFile(file: File): Promise<void> {
  try {
    const known = volume.value?.labels.map(({ label }) => label) ?? [];
    const entries = readLegend(file.name, await file.text()).filter(({ label }) => known.includes(label));
    if (entries.length === 0)
      throw new Error(
        `${file.name} names none of the labels ${known.slice(0, 12).join(', ')}; they stay as they are`,
      );
    editLegend('Names of labels', entries);
    tell('news', 'Labels are named', `${file.name} names ${entries.length} of ${known.length} labels.`);
  } catch (error) {
    tellError(error);
  }
}
