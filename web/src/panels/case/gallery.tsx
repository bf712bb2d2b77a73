import { openExample } from '../../store/case/open_case';
import { gallery } from '../../store/case/gallery';
import { activity } from '../../store/run/stages';

/** Examples to open with a click, each with its picture. */
export function Gallery({ onOpen }: { onOpen?: () => void }) {
  return (
    <ul class="gallery" aria-label="Examples">
      {gallery.map((example) => (
        <li key={example.name}>
          <button
            type="button"
            disabled={activity.value === 'starting'}
            onClick={() => {
              void openExample(example);
              onOpen?.();
            }}
          >
            <img src={`gallery/${example.name}.png`} alt="" width="150" height="100" loading="lazy" />
            <span class="gallery-title">{example.title}</span>
            <span class="gallery-text">{example.text}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}
