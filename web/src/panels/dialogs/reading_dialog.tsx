/** How a file is to be read, where it leaves that open or says it wrongly. */
import { useState } from 'preact/hooks';
import { volume } from '../../store/case/input';
import { unread } from '../../store/case/open_files';
import { overlapping, readAgain, readingOf, type Reading } from '../../store/case/reading';
import { recipe } from '../../store/case/recipe';
import { defaults } from '../../store/run/stages';
import { Dialog } from '../controls/dialog';
import { NumberInput, SelectField } from '../controls/fields';

const units: readonly (readonly [Reading['unit'], string])[] = [
  ['file', 'as the file says'],
  ['m', 'm'],
  ['cm', 'cm'],
  ['mm', 'mm'],
  ['um', 'µm'],
  ['nm', 'nm'],
];

/** Which segment wins where several overlap: the upper one. They are dragged, or moved by buttons. */
function Precedence({ names, onChange }: { names: readonly string[]; onChange(names: string[]): void }) {
  const [dragged, setDragged] = useState<string | null>(null);
  const move = (name: string, place: number) =>
    onChange(names.filter((n) => n !== name).toSpliced(place, 0, name));
  const dragOver = (event: DragEvent, place: number) => {
    if (dragged === null) return;
    event.preventDefault();
    if (names[place] !== dragged) move(dragged, place);
  };
  return (
    <div class="field field-vector">
      <span class="field-label">Where segments overlap, the upper one wins</span>
      <ol class="precedence">
        {names.map((name, place) => (
          <li
            key={name}
            draggable
            data-dragged={dragged === name}
            onDragStart={() => setDragged(name)}
            onDragOver={(event) => dragOver(event, place)}
            onDrop={(event) => event.preventDefault()}
            onDragEnd={() => setDragged(null)}
          >
            <span>{name}</span>
            <button
              type="button"
              class="button"
              aria-label={`Move ${name} up`}
              disabled={place === 0}
              onClick={() => move(name, place - 1)}
            >
              ↑
            </button>
            <button
              type="button"
              class="button"
              aria-label={`Move ${name} down`}
              disabled={place === names.length - 1}
              onClick={() => move(name, place + 1)}
            >
              ↓
            </button>
          </li>
        ))}
      </ol>
    </div>
  );
}

export function ReadingDialog({ close }: { close(): void }) {
  const failed = unread.value;
  const source = failed ? defaults.value?.source : recipe.value?.source;
  const [reading, setReading] = useState<Reading | null>(source ? readingOf(source) : null);
  if (!reading) return null;
  const known = failed ? null : volume.value;
  const named = reading.precedence;
  const others = overlapping(known?.labels ?? [], known?.warnings ?? []).filter(
    (name) => !named.includes(name),
  );
  const segments = [...named, ...others];
  const set = (change: Partial<Reading>) => setReading({ ...reading, ...change });
  const read = () => {
    close();
    void readAgain(reading, failed?.file ?? null);
  };
  return (
    <Dialog title="How the file is read" onClose={close}>
      {failed && <p class="stale">{failed.message}</p>}
      <SelectField
        label="Unit of its lengths"
        value={reading.unit}
        options={units}
        onChange={(unit) => set({ unit })}
      />
      <div class="field">
        <span class="field-label">Value of the background</span>
        <span class="field-input">
          <NumberInput
            label="Value of the background"
            path="source.background"
            value={reading.background}
            onChange={(background) => background !== null && set({ background })}
          />
        </span>
      </div>
      <div class="field" title="Of a file with several, counted from 0">
        <span class="field-label">Frame</span>
        <span class="field-input">
          <NumberInput
            label="Frame"
            path="source.frame"
            value={reading.frame < 0 ? null : reading.frame}
            placeholder="all"
            onChange={(frame) => set({ frame: frame ?? -1 })}
          />
        </span>
      </div>
      {reading.threshold && (
        <div class="field" title="Values of the image that become label 1">
          <span class="field-label">Values of label 1</span>
          <span class="field-input">
            {(['lower', 'upper'] as const).map((end) => (
              <NumberInput
                key={end}
                label={end === 'lower' ? 'Smallest value of label 1' : 'Largest value of label 1'}
                path={`source.threshold.${end}`}
                value={reading.threshold?.[end] ?? null}
                onChange={(value) =>
                  value !== null &&
                  reading.threshold &&
                  set({ threshold: { ...reading.threshold, [end]: value } })
                }
              />
            ))}
          </span>
        </div>
      )}
      {segments.length > 1 && <Precedence names={segments} onChange={(precedence) => set({ precedence })} />}
      <div class="dialog-actions">
        <button type="button" class="button" onClick={close}>
          Cancel
        </button>
        <button type="button" class="button primary" onClick={read}>
          Read it so
        </button>
      </div>
    </Dialog>
  );
}
