import { effect } from '@preact/signals';
import {
  BufferGeometry,
  MathUtils,
  Mesh,
  OrthographicCamera,
  Scene,
  Vector3,
  type RawShaderMaterial,
} from 'three';
import {
  coordinate,
  cross,
  dot,
  obliqueness,
  sidesOf,
  toMm,
  type SliceFrame,
} from '../../geometry/orientation';
import type { TetArrays, Vec3 } from '../../engine/contract';
import { typicalEdge } from '../../geometry/section';
import { slicePlaces } from '../../store/view';
import type { Canvas, Pane } from '../frame/canvas';
import { setPositions } from '../frame/positions';
import type { Grid } from '../../geometry/grid_values';
import type { SliceImage } from './slice_material';
import { Contour } from './contour';
import { SliceBrush } from './slice_brush';
import { SliceInput, type SteeredSlice } from './slice_input';
import { SliceLabel } from './slice_label';
import { SliceRegions } from './slice_regions';

/** The edges of elements in the plane of the uniform `cutPlane`, as strong as `strength` says. */
export type Edges = Mesh<BufferGeometry, RawShaderMaterial>;

interface Elements {
  mesh: TetArrays;
  edges: Edges;
}

const titles = { axial: 'Axial', coronal: 'Coronal', sagittal: 'Sagittal' } as const;
/** Degrees from the patient's axes. */
const clearlyOblique = 5;
const axisNames = ['i', 'j', 'k'];
const patientNames = { axial: 'S', coronal: 'A', sagittal: 'R' } as const;
const help =
  'Drag to move the crosshair, wheel or page keys to go through the slices, arrow keys to step, ' +
  'Shift and drag to shift, Ctrl and wheel, plus and minus to zoom, 0 for the whole slice.';
const hints = {
  mouse: 'Wheel: next slice. Ctrl and wheel, or pinch: zoom. Shift and drag: move.',
  touch: 'One finger: crosshair. Two: zoom and move.',
};
/** Pixels between edges at which they begin to be seen, and at which they are as strong as they get. */
const crowded = [3, 9] as const;
const fullStrength = 0.7;

function part<K extends keyof HTMLElementTagNameMap>(name: K, className: string, parent: HTMLElement) {
  const element = document.createElement(name);
  element.className = className;
  parent.append(element);
  return element;
}

/** One slice across an image axis, as radiologists look at it, with its crosshair and the patient's sides. */
export class SlicePane implements SteeredSlice {
  readonly root: HTMLElement;
  readonly surface: HTMLElement;
  private readonly canvas: Canvas;
  private readonly image: SliceImage;
  private readonly camera = new OrthographicCamera();
  private readonly scene = new Scene();
  private readonly quad: Mesh<BufferGeometry>;
  readonly slider: HTMLInputElement;
  private readonly name: HTMLElement;
  private readonly place: HTMLElement;
  private readonly number: HTMLElement;
  private readonly letters: HTMLElement[];
  private readonly lines: HTMLElement[];
  private readonly pane: Pane;
  readonly regions: SliceRegions;
  readonly brush: SliceBrush;
  readonly label: SliceLabel;
  private readonly contour = new Contour();
  private readonly stop: () => void;
  frame: SliceFrame;
  grid: Grid;
  private elements: Elements | null = null;
  private plane: { normal: Vec3; offset: number } = { normal: [0, 0, 1], offset: 0 };
  /** What of the body in the plane has to be found anew before it is drawn. */
  private readonly stale = { borders: false, strength: false };
  private middle = new Vector3();
  private mmPerPixel = 1;
  private zoom = 1;
  private size: [number, number] = [1, 1];

  constructor(canvas: Canvas, parent: HTMLElement, image: SliceImage, frame: SliceFrame) {
    this.canvas = canvas;
    this.image = image;
    this.frame = frame;
    this.grid = image.grid;
    this.root = part('div', `pane slice ${frame.name}`, parent);
    this.surface = part('div', 'pane-surface', this.root);
    this.surface.tabIndex = 0;
    this.surface.setAttribute('role', 'img');
    this.lines = ['vertical', 'horizontal'].map((name) => part('i', `cross ${name}`, this.root));
    const head = part('div', 'pane-head', this.root);
    this.name = part('span', 'pane-name', head);
    this.name.textContent = titles[frame.name];
    this.slider = part('input', 'pane-slider', head);
    this.slider.type = 'range';
    this.slider.min = '0';
    this.slider.setAttribute('aria-label', `${titles[frame.name]} slice`);
    this.place = part('span', 'pane-place', head);
    this.number = part('span', 'pane-number', this.place);
    this.addZoom();
    this.letters = ['left', 'right', 'top', 'bottom'].map((side) => part('span', `side ${side}`, this.root));
    this.quad = new Mesh(new BufferGeometry(), image.material);
    this.quad.frustumCulled = false;
    this.scene.add(this.quad, this.contour.group);
    this.pane = {
      element: this.surface,
      resized: (width, height) => {
        this.size = [width, height];
        this.contour.setPane(width, height);
        this.fit();
      },
      draw: (renderer) => {
        this.refresh();
        renderer.render(this.scene, this.camera);
      },
    };
    canvas.add(this.pane);
    const plane = {
      size: () => this.size,
      mmPerPixel: () => this.mmPerPixel,
      mmAt: (x: number, y: number) => this.mmAt(x, y),
    };
    this.regions = new SliceRegions(this.root, plane);
    this.brush = new SliceBrush(this.root, plane);
    this.label = new SliceLabel(this.root, plane);
    new SliceInput(this);
    this.stop = effect(() => {
      this.follow(slicePlaces.value);
    });
  }

  /** Another image, or another orientation of it. */
  setFrame(frame: SliceFrame): void {
    this.frame = frame;
    this.grid = this.image.grid;
    this.zoom = 1;
    const { size, indexToMm } = this.grid;
    this.slider.max = String(size[frame.across] - 1);
    const turned = obliqueness(indexToMm) > clearlyOblique;
    this.name.textContent = `${titles[frame.name]}${turned ? ', oblique' : ''}`;
    this.surface.setAttribute('aria-label', `${titles[frame.name]} slice. ${help}`);
    const opposite = frame.right.map((x) => -x) as Vec3;
    const down = frame.up.map((x) => -x) as Vec3;
    [opposite, frame.right, frame.up, down].forEach((way, i) => (this.letters[i].textContent = sidesOf(way)));
    this.middle.set(
      ...toMm(
        indexToMm,
        size.map((n) => (n - 1) / 2),
      ),
    );
    this.fit();
    this.follow(slicePlaces.peek());
  }

  /** Triangles where labels meet, nine numbers each. */
  setBorders(triangles: Float32Array): void {
    this.contour.setTriangles(triangles);
    this.stale.borders = true;
  }

  setElements(elements: Elements | null): void {
    this.dropElements();
    this.elements = elements;
    if (elements) this.scene.add(elements.edges);
    this.cut();
  }

  dispose(): void {
    this.stop();
    this.regions.dispose();
    this.brush.dispose();
    this.label.dispose();
    this.dropElements();
    this.contour.dispose();
    this.canvas.remove(this.pane);
    this.quad.geometry.dispose();
    this.root.remove();
  }

  get centre(): Vec3 {
    const { size, indexToMm } = this.grid;
    return toMm(
      indexToMm,
      slicePlaces.peek().map((place, axis) => Math.round(place * (size[axis] - 1))),
    );
  }

  get index(): number {
    const { across } = this.frame;
    return Math.round(slicePlaces.peek()[across] * (this.grid.size[across] - 1));
  }

  private follow(places: Vec3): void {
    const { across, name } = this.frame;
    const { size } = this.grid;
    const corners = this.image.corners(across, places[across]);
    const positions = Float32Array.from(corners.flatMap((corner) => corner.toArray()));
    setPositions(this.quad.geometry, positions);
    const { centre } = this;
    const edge = (to: number) => corners[to].clone().sub(corners[0]).toArray() as Vec3;
    const normal = new Vector3(...cross(edge(1), edge(5))).normalize().toArray();
    const offset = dot(normal, centre);
    if (offset !== this.plane.offset || normal.some((x, row) => x !== this.plane.normal[row])) {
      this.plane = { normal, offset };
      this.stale.borders = true;
      this.cut();
    }
    this.slider.value = String(this.index);
    const side = patientNames[name];
    const mm = centre[{ R: 0, A: 1, S: 2 }[side]];
    const number = `${axisNames[across]} ${this.index + 1}/${size[across]} · `;
    const position = `${side} ${coordinate(mm)} mm`;
    this.place.replaceChildren(this.number, position);
    this.number.textContent = number;
    this.slider.setAttribute('aria-valuetext', number + position);
    this.placeLines(centre);
    this.regions.draw();
    this.canvas.invalidate();
  }

  /** Puts the edges of elements into the plane of the slice. */
  private cut(): void {
    const { normal, offset } = this.plane;
    this.elements?.edges.material.uniforms.cutPlane.value.set(...normal, offset);
    this.stale.strength = true;
  }

  private dropElements(): void {
    if (!this.elements) return;
    const { edges } = this.elements;
    this.scene.remove(edges);
    edges.geometry.dispose();
    edges.material.dispose();
    this.elements = null;
  }

  /** Before it is drawn, not with every move. */
  private refresh(): void {
    const { stale, elements, plane, mmPerPixel } = this;
    if (stale.borders) this.contour.cutAt(plane.normal, plane.offset);
    if (stale.strength && elements) {
      // One strength for all edges of a slice: what is seen of it says how crowded they are.
      const [right, up] = [this.frame.right, this.frame.up];
      const middle = this.middle.toArray();
      const [x, y] = [dot(middle, right), dot(middle, up)];
      const [wide, tall] = this.size.map((pixels) => (pixels / 2) * mmPerPixel);
      const inSight = (...p: Vec3) => Math.abs(dot(p, right) - x) < wide && Math.abs(dot(p, up) - y) < tall;
      const pixels = typicalEdge(elements.mesh, plane.normal, plane.offset, inSight) / mmPerPixel;
      const { edges } = elements;
      edges.material.uniforms.strength.value = fullStrength * MathUtils.smoothstep(pixels, ...crowded);
      edges.visible = pixels > crowded[0];
    }
    stale.borders = stale.strength = false;
  }

  private placeLines(centre: Vec3): void {
    const away = new Vector3(...centre).sub(this.middle);
    const [width, height] = this.size;
    const x = width / 2 + away.dot(new Vector3(...this.frame.right)) / this.mmPerPixel;
    const y = height / 2 - away.dot(new Vector3(...this.frame.up)) / this.mmPerPixel;
    this.lines[0].style.transform = `translateX(${x.toFixed(1)}px)`;
    this.lines[1].style.transform = `translateY(${y.toFixed(1)}px)`;
  }

  /** The whole image across this axis, times the zoom. */
  private fit(): void {
    const { size, indexToMm } = this.grid;
    const [width, height] = this.size;
    let across = 1;
    let upright = 1;
    const middle = toMm(
      indexToMm,
      size.map((n) => (n - 1) / 2),
    );
    for (let corner = 0; corner < 8; corner++) {
      const at = toMm(
        indexToMm,
        size.map((n, axis) => ((corner >> axis) & 1 ? n - 0.5 : -0.5)),
      ).map((x, row) => x - middle[row]);
      across = Math.max(across, Math.abs(dot(at, this.frame.right)));
      upright = Math.max(upright, Math.abs(dot(at, this.frame.up)));
    }
    // Room for the letters and the head line.
    this.mmPerPixel =
      Math.max((2 * across) / Math.max(40, width - 44), (2 * upright) / Math.max(40, height - 76)) /
      this.zoom;
    this.look();
  }

  private look(): void {
    const { camera, mmPerPixel, middle, frame, size } = this;
    camera.right = (size[0] / 2) * mmPerPixel;
    camera.left = -camera.right;
    camera.top = (size[1] / 2) * mmPerPixel;
    camera.bottom = -camera.top;
    camera.near = 1;
    camera.far = 8000;
    camera.up.set(...frame.up);
    camera.position.copy(middle).addScaledVector(new Vector3(...frame.towards), 4000);
    camera.lookAt(middle);
    camera.updateProjectionMatrix();
    this.stale.strength = true;
    this.placeLines(this.centre);
    this.regions.draw();
    this.canvas.invalidate();
  }

  mmAt(px: number, py: number): Vec3 {
    const x = (px - this.size[0] / 2) * this.mmPerPixel;
    const y = (this.size[1] / 2 - py) * this.mmPerPixel;
    const { right, up, towards } = this.frame;
    const depth = dot(towards, this.centre) - dot(towards, this.middle.toArray());
    return this.middle
      .toArray()
      .map((m, row) => m + x * right[row] + y * up[row] + depth * towards[row]) as Vec3;
  }

  zoomBy(factor: number, [px, py]: [number, number] = [this.size[0] / 2, this.size[1] / 2]): void {
    const before = this.mmPerPixel;
    this.zoom = Math.max(0.5, Math.min(40, this.zoom * factor));
    this.root.parentElement?.classList.add('zoom-known');
    this.fit();
    // What is under the place stays under it.
    const away = before / this.mmPerPixel - 1;
    this.shiftBy((this.size[0] / 2 - px) * away, (this.size[1] / 2 - py) * away);
  }

  shiftBy(px: number, py: number): void {
    this.middle
      .addScaledVector(new Vector3(...this.frame.right), -px * this.mmPerPixel)
      .addScaledVector(new Vector3(...this.frame.up), py * this.mmPerPixel);
    this.look();
  }

  reset(): void {
    this.setFrame(this.frame);
  }

  private addZoom(): void {
    const group = part('div', 'pane-zoom', this.root);
    const ways: [string, string, () => void][] = [
      ['+', 'Zoom in (+)', () => this.zoomBy(1.25)],
      ['−', 'Zoom out (−)', () => this.zoomBy(0.8)],
      ['Fit', 'The whole slice (0)', () => this.reset()],
    ];
    for (const [text, title, go] of ways) {
      const button = part('button', '', group);
      button.type = 'button';
      button.textContent = text;
      button.title = title;
      button.setAttribute('aria-label', `${titles[this.frame.name]}: ${title}`);
      button.addEventListener('click', go);
    }
    const hint = part('p', 'pane-hint', this.root);
    for (const [kind, text] of Object.entries(hints)) part('span', kind, hint).textContent = text;
  }
}
