import { colourStops } from '../../geometry/colours';
import type { Legend } from '../../store/view';
import type { Canvas } from './canvas';

/** Pixels of the picture for each of the screen. */
const finer = 2;
const font = '"Inter Variable", system-ui, sans-serif';

function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** What stands beside a scale, and where: 0 is its lower end. */
function marksOf({ lo, hi, words }: Legend): [string, number][] {
  return (
    words?.map((word, i): [string, number] => [word, 1 - (i + 0.5) / words.length]) ??
    [0, 0.25, 0.5, 0.75, 1].map((t) => [String(Number((lo + t * (hi - lo)).toPrecision(3))), t])
  );
}

function drawLegend(context: CanvasRenderingContext2D, shown: Legend, right: number, bottom: number): void {
  const [width, height] = [14, 120];
  const [x, y] = [right - (shown.words ? 76 : 64), bottom - height];
  const scale = context.createLinearGradient(0, bottom, 0, y);
  const stops = colourStops(shown.map);
  stops.forEach((colour, i) => scale.addColorStop(i / (stops.length - 1), colour));
  context.fillStyle = scale;
  context.fillRect(x, y, width, height);
  context.fillStyle = cssColour('--text');
  context.font = `11.5px ${font}`;
  context.textAlign = 'left';
  for (const [text, t] of marksOf(shown)) context.fillText(text, x + width + 6, bottom - t * height + 4);
  context.font = `600 12px ${font}`;
  context.textAlign = 'right';
  context.fillText(`${shown.title}${shown.unit && `, ${shown.unit}`}`, right, y - 12);
}

/** Texts that stand over the panes: sides, titles, places, the scale bar. */
function drawTexts(context: CanvasRenderingContext2D, host: HTMLElement): void {
  const frame = host.getBoundingClientRect();
  for (const element of host.querySelectorAll<HTMLElement>(
    '.side, .pane-name, .pane-place, .scale-bar span',
  )) {
    const box = element.getBoundingClientRect();
    if (box.width === 0) continue;
    const style = getComputedStyle(element);
    context.fillStyle = style.color;
    context.font = `${style.fontWeight} ${style.fontSize} ${font}`;
    context.textAlign = 'left';
    context.fillText(
      element.textContent ?? '',
      box.left - frame.left,
      box.bottom - frame.top - 0.28 * box.height,
    );
  }
  for (const element of host.querySelectorAll<HTMLElement>('.scale-bar i, .cross')) {
    const box = element.getBoundingClientRect();
    if (box.width === 0) continue;
    const style = getComputedStyle(element);
    context.fillStyle = element.classList.contains('cross') ? style.backgroundColor : style.color;
    const tall = element.classList.contains('cross') ? box.height : 1.5;
    context.fillRect(box.left - frame.left, box.bottom - frame.top - tall, box.width, tall);
  }
}

/** The view as it stands, twice as fine as on the screen, with its scale bar, letters and legend. */
export function takePicture(canvas: Canvas, host: HTMLElement, shown: Legend | null): Promise<Blob> {
  const { clientWidth: width, clientHeight: height } = host;
  const page = document.createElement('canvas');
  page.width = finer * width;
  page.height = finer * height;
  const context = page.getContext('2d');
  if (!context) return Promise.reject(new Error('This browser gives no canvas to draw the picture on.'));
  const background = context.createLinearGradient(0, 0, 0, page.height);
  background.addColorStop(0, cssColour('--view-top'));
  background.addColorStop(1, cssColour('--view-bottom'));
  context.fillStyle = background;
  context.fillRect(0, 0, page.width, page.height);
  canvas.drawFiner(finer, (drawn) => context.drawImage(drawn, 0, 0, page.width, page.height));
  context.scale(finer, finer);
  drawTexts(context, host);
  const model = host.querySelector('.pane.model')?.getBoundingClientRect();
  const bottom = (model?.bottom ?? 0) - host.getBoundingClientRect().top;
  if (shown) drawLegend(context, shown, width - 14, bottom - 52);
  return new Promise((made, failed) =>
    page.toBlob(
      (blob) => (blob ? made(blob) : failed(new Error('The picture could not be made.'))),
      'image/png',
    ),
  );
}
