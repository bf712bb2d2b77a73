import { colourStops } from '../../geometry/colours';
import { boxesOf, clipped, ticksOf } from '../../geometry/scale';
import type { Legend } from '../../store/view';
import type { Canvas } from './canvas';

/** Pixels of the picture for each of the screen. */
const finer = 2;
const font = '"Inter Variable", system-ui, sans-serif';

function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

const chart = 22;
const bar = 11;

/** A scale below the body, as the page has it: counts, colours, ticks; `bottom` is its lower end. */
function drawLegend(context: CanvasRenderingContext2D, shown: Legend, middle: number, bottom: number): void {
  const width = 290;
  const [left, top] = [middle - width / 2, bottom - 16 - bar];
  const { title, unit, map, counts, values, words } = shown;
  const most = Math.max(1, ...(counts ?? []));
  const place = (text: string, x: number, y: number, align: CanvasTextAlign, weight = 400) => {
    context.font = `${weight} 11.5px ${font}`;
    context.textAlign = align;
    context.fillText(text, x, y);
  };
  context.fillStyle = cssColour('--line-strong');
  counts?.forEach((count, i) => {
    const tall = count > 0 ? 1.5 + (chart - 3.5) * (count / most) : 0;
    context.globalAlpha = 0.45;
    context.fillRect(left + (i * width) / counts.length, top - tall, width / counts.length, tall);
  });
  context.globalAlpha = 1;
  const scale = context.createLinearGradient(left, 0, left + width, 0);
  const stops = colourStops(map);
  stops.forEach((colour, i) => scale.addColorStop(i / (stops.length - 1), colour));
  context.fillStyle = scale;
  context.fillRect(left, top, width, bar);
  for (const { from, to, colour } of boxesOf(shown)) {
    context.fillStyle = colour;
    context.fillRect(left + from * width, top, (to - from) * width, bar);
  }
  context.fillStyle = cssColour('--text');
  for (const { at, text } of ticksOf(shown)) {
    context.fillRect(left + at * width - 0.5, top + bar, 1, 3);
    place(text, left + at * width, top + bar + 14, 'center');
  }
  const { below, above } = clipped(shown);
  if (below) place('<', left - 4, top + 10, 'right', 650);
  if (above) place('>', left + width + 4, top + 10, 'left', 650);
  const head = top - (counts ? chart : 0) - 6;
  place(`${title}${unit && `, ${unit}`}`, left, head, 'left', 600);
  const number = (value: number) => String(Number(value.toPrecision(3))).replace('-', '−');
  if (values && !words) place(values.map(number).join(' to '), left + width, head, 'right');
}

/** The cross of the patient's directions. */
function drawTriad(context: CanvasRenderingContext2D, host: HTMLElement): void {
  const frame = host.getBoundingClientRect();
  for (const part of host.querySelectorAll<SVGGraphicsElement>('.triad line, .triad circle, .triad text')) {
    const triad = part.ownerSVGElement?.getBoundingClientRect();
    const style = getComputedStyle(part);
    if (!triad || triad.width === 0 || style.display === 'none') continue;
    const number = (name: string) => Number(part.getAttribute(name));
    context.save();
    context.translate(triad.left - frame.left, triad.top - frame.top);
    context.fillStyle = style.fill;
    context.strokeStyle = style.stroke;
    context.lineWidth = Number.parseFloat(style.strokeWidth);
    context.beginPath();
    if (part.tagName === 'line') {
      context.moveTo(number('x1'), number('y1'));
      context.lineTo(number('x2'), number('y2'));
      context.stroke();
    } else if (part.tagName === 'circle') {
      context.arc(number('cx'), number('cy'), number('r'), 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    } else {
      context.font = `${style.fontWeight} ${style.fontSize} ${font}`;
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      context.fillText(part.textContent ?? '', number('x'), number('y') + 0.5);
    }
    context.restore();
  }
}

/** Squares of colour with what they mean. */
function drawKey(context: CanvasRenderingContext2D, host: HTMLElement): void {
  const frame = host.getBoundingClientRect();
  for (const entry of host.parentElement?.querySelectorAll<HTMLElement>('.label-key li') ?? []) {
    const [dot, name] = [entry.querySelector('rect'), entry.querySelector('span') ?? entry];
    const box = dot?.getBoundingClientRect();
    const text = name.getBoundingClientRect();
    if (text.width === 0) continue;
    if (dot && box) {
      context.fillStyle = getComputedStyle(dot).fill;
      context.fillRect(box.left - frame.left, box.top - frame.top, box.width, box.height);
    }
    const style = getComputedStyle(name);
    context.fillStyle = style.color;
    context.font = `${style.fontWeight} ${style.fontSize} ${font}`;
    context.textAlign = 'left';
    context.fillText(
      name.textContent ?? '',
      text.left - frame.left,
      text.bottom - frame.top - 0.28 * text.height,
    );
  }
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

/** The view as it stands, twice as fine as on the screen, with its scale bar, directions, letters and legend. */
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
  drawTriad(context, host);
  drawKey(context, host);
  const model = host.querySelector('.pane.model')?.getBoundingClientRect();
  const frame = host.getBoundingClientRect();
  if (shown && model)
    drawLegend(context, shown, model.left + model.width / 2 - frame.left - 6, model.bottom - frame.top - 8);
  return new Promise((made, failed) =>
    page.toBlob(
      (blob) => (blob ? made(blob) : failed(new Error('The picture could not be made.'))),
      'image/png',
    ),
  );
}
