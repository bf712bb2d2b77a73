/** The study whose results are open beside the case, and the files that it comes from. */
import { signal } from '@preact/signals';
import { announcement, dismissErrors, tell } from '../notices';
import type { Study } from './read_study';

export interface OpenStudy extends Study {
  /** Tells it from one that was opened before. */
  id: number;
}

export const study = signal<OpenStudy | null>(null);
/** Whether the study stands in front of the case. */
export const studyShown = signal(false);

export interface StudyFiles {
  table: File;
  costs: File | undefined;
  /** What does not belong to them. */
  rest: File[];
}

/** Of a line that is longer, so much says what it is. */
const startBytes = 1 << 16;

async function firstLine(file: File): Promise<string> {
  return (await file.slice(0, startBytes).text()).split('\n', 1)[0].trim();
}

const isRow = (line: string) =>
  line.startsWith('{') && ['case', 'key', 'status', 'link'].every((field) => line.includes(`"${field}":`));
const isCostsHead = (line: string) => line.startsWith('case,') && line.split(',').includes('seconds');

/** The table of a study among files, known by its first line or else by its name; null where there is none. */
export async function findStudy(files: readonly File[]): Promise<StudyFiles | null> {
  const lines = await Promise.all(files.map(firstLine));
  const table =
    files.find((_, i) => isRow(lines[i])) ?? files.find(({ name }) => name.toLowerCase().endsWith('.jsonl'));
  if (!table) return null;
  const costs = files.find((_, i) => isCostsHead(lines[i]));
  return { table, costs, rest: files.filter((file) => file !== table && file !== costs) };
}

const named = async (file: File) => ({ name: file.name, text: await file.text() });

let opened = 0;

/** Shows the results of a study in front of the case, which stays open. */
export async function openStudy({ table, costs }: StudyFiles): Promise<void> {
  const [{ readStudy }, { summaryOf }] = await Promise.all([import('./read_study'), import('./rows')]);
  try {
    study.value = {
      ...readStudy(await named(table), costs && (await named(costs))),
      id: ++opened,
    };
  } catch (error) {
    tell('error', 'This study cannot be read', (error as Error).message);
    return;
  }
  dismissErrors();
  studyShown.value = true;
  announcement.value = `Study opened. ${summaryOf(study.value)}`;
}

export function closeStudy(): void {
  studyShown.value = false;
  study.value = null;
}
