import { useEffect } from 'preact/hooks';
import { keepFibres } from '../../store/run/fibres';
import { fibreStyle, seeThrough, type FibreStyle } from '../../store/view';
import { Segments } from '../controls/fields';

const styles: [FibreStyle, string, string][] = [
  ['none', 'No fibres', 'Fibres are not drawn'],
  ['glyphs', 'Glyphs', 'Short pieces along the fibres, some 3,000 evenly spread'],
  ['lines', 'Lines', 'Lines that follow the fibres from end to end'],
];

/** How muscle fibres are drawn, where the case has some. */
export function FibreTool() {
  useEffect(keepFibres, []);
  return (
    <>
      <Segments
        label="Fibres"
        value={fibreStyle.value}
        options={styles}
        onChange={(next) => (fibreStyle.value = next)}
      />
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
