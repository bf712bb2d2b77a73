import { Vector3 } from 'three';
import { command, type ViewDirection } from '../../store/view';
import type { Viewer } from './viewer';

const svgNamespace = 'http://www.w3.org/2000/svg';
const axes: [ViewDirection, ViewDirection, Vector3, string][] = [
  ['R', 'L', new Vector3(1, 0, 0), 'x'],
  ['A', 'P', new Vector3(0, 1, 0), 'y'],
  ['S', 'I', new Vector3(0, 0, 1), 'z'],
];

function svg<K extends keyof SVGElementTagNameMap>(name: K, attributes: Record<string, string | number>) {
  const element = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}

/** The patient's directions as a small cross; its letters are buttons that turn the view. */
export function addTriad(viewer: Viewer, container: HTMLElement): void {
  const size = 88;
  const reach = 28;
  const root = svg('svg', { class: 'triad', viewBox: `0 0 ${size} ${size}`, width: size, height: size });
  root.setAttribute('role', 'group');
  root.setAttribute('aria-label', "View along the patient's axes");
  const names: Record<ViewDirection, string> = {
    R: 'right',
    L: 'left',
    A: 'front',
    P: 'back',
    S: 'head',
    I: 'feet',
  };
  const ends = axes.flatMap(([plus, minus, axis, kind]) =>
    [plus, minus].map((letter, side) => {
      const group = svg('g', {
        class: `triad-end ${kind} ${side ? 'minus' : 'plus'}`,
        tabindex: 0,
        role: 'button',
      });
      group.setAttribute('aria-label', `View from the patient's ${names[letter]}`);
      const line = svg('line', { x1: size / 2, y1: size / 2 });
      const disc = svg('circle', { r: 8.5 });
      const text = svg('text', { 'text-anchor': 'middle', dy: '0.35em' });
      text.textContent = letter;
      group.append(line, disc, text);
      const go = () => (command.value = { kind: 'look', from: letter });
      group.addEventListener('click', go);
      group.addEventListener('keydown', (event) => {
        if (event.key === 'Enter' || event.key === ' ') {
          event.preventDefault();
          go();
        }
      });
      return { group, line, disc, text, axis: axis.clone().multiplyScalar(side ? -1 : 1) };
    }),
  );
  root.append(...ends.map((end) => end.group));
  container.append(root);
  let order = '';
  viewer.onDraw(() => {
    const turn = viewer.camera.quaternion.clone().invert();
    const placed = ends.map((end) => ({ end, at: end.axis.clone().applyQuaternion(turn) }));
    for (const { end, at } of placed) {
      const x = size / 2 + reach * at.x;
      const y = size / 2 - reach * at.y;
      end.line.setAttribute('x2', x.toFixed(1));
      end.line.setAttribute('y2', y.toFixed(1));
      for (const [part, px, py] of [
        [end.disc, 'cx', 'cy'],
        [end.text, 'x', 'y'],
      ] as const) {
        part.setAttribute(px, x.toFixed(1));
        part.setAttribute(py, y.toFixed(1));
      }
    }
    placed.sort((a, b) => a.at.z - b.at.z);
    const next = placed.map(({ end }) => end.text.textContent).join('');
    // Re-inserting the groups costs the keyboard focus, so only when the order changed.
    if (next !== order && !root.contains(document.activeElement)) {
      order = next;
      root.append(...placed.map(({ end }) => end.group));
    }
  });
}

/** A bar of a round number of millimetres, true at the depth of the point that the view turns about. */
export function addScaleBar(viewer: Viewer, container: HTMLElement): void {
  const root = document.createElement('div');
  root.className = 'scale-bar';
  const text = document.createElement('span');
  const bar = document.createElement('i');
  root.append(text, bar);
  container.append(root);
  viewer.onDraw(() => {
    const distance = viewer.camera.position.distanceTo(viewer.controls.target);
    const height = 2 * distance * Math.tan((viewer.camera.fov * Math.PI) / 360);
    const pixelsPerMm = container.clientHeight / height;
    const longest = 90 / pixelsPerMm;
    const power = 10 ** Math.floor(Math.log10(longest));
    const round = [5, 2, 1].find((step) => step * power <= longest) ?? 1;
    const length = round * power;
    bar.style.width = `${(length * pixelsPerMm).toFixed(1)}px`;
    text.textContent =
      length >= 10 && length % 10 === 0 && length >= 100 ? `${length / 10} cm` : `${length} mm`;
  });
}
