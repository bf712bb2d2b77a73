import { useEffect } from 'preact/hooks';
import { keepFibres } from '../../store/run/fibres';
import { fibreStyle, seeThrough, type FibreStyle } from '../../store/view';

const styles: [FibreStyle, string][] = [
  ['none', 'No fibres'],
  ['glyphs', 'Fibre glyphs'],
  ['lines', 'Fibre lines'],
];

/** How muscle fibres are drawn, where the case has some. */
export function FibreTool() {
  useEffect(keepFibres, []);
  return (
    <>
      <label
        class="tool-field"
        title="Glyphs: some 3,000 short pieces, evenly spread. Lines follow the fibres from end to end."
      >
        <select
          aria-label="Fibres"
          value={fibreStyle.value}
          onChange={(event) => (fibreStyle.value = event.currentTarget.value as FibreStyle)}
        >
          {styles.map(([style, text]) => (
            <option key={style} value={style} selected={style === fibreStyle.value}>
              {text}
            </option>
          ))}
        </select>
      </label>
      {fibreStyle.value !== 'none' && (
        <button
          type="button"
          class="tool"
          aria-pressed={seeThrough.value}
          title="The body is an outline around its fibres"
          onClick={() => (seeThrough.value = !seeThrough.value)}
        >
          See through
        </button>
      )}
    </>
  );
}
