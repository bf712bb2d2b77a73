import { Box3, PerspectiveCamera, Quaternion, Scene, Sphere, Vector3, type Object3D } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Camera, ViewDirection } from '../../store/view';
import type { Canvas, Pane } from './canvas';

const directions: Record<ViewDirection, [number, number, number]> = {
  R: [1, 0, 0],
  L: [-1, 0, 0],
  A: [0, 1, 0],
  P: [0, -1, 0],
  S: [0, 0, 1],
  I: [0, 0, -1],
};

const flightMs = 420;
/** Share of the view that a fitted body fills. */
const fitShare = 0.84;
/** From the patient's left front and a little above, as hearts are drawn. */
const threeQuarters = new Vector3(-0.62, 1, 0.4).normalize();

/** What the camera looks at, from which direction and how far away. */
interface Sight {
  target: Vector3;
  direction: Vector3;
  distance: number;
}

/** A pane that is looked into from any side: scene, camera and controls. */
export class Viewer {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 1, 5000);
  readonly controls: OrbitControls;
  /** Takes the events, and says how large the pane is. */
  readonly element: HTMLElement;
  /** The body that the view is fitted to and cut along. */
  readonly bounds = new Box3(new Vector3(-50, -50, -50), new Vector3(50, 50, 50));
  private readonly canvas: Canvas;
  private readonly pane: Pane;
  private readonly afterDraw = new Set<() => void>();
  private outline: Float32Array = new Float32Array(0);
  private share = fitShare;
  /** The view is that of the whole body, which nobody has turned or zoomed. */
  private fitted = false;
  private flight: { begin: number; from: Sight; to: Sight } | null = null;

  constructor(canvas: Canvas, parent: HTMLElement) {
    this.canvas = canvas;
    this.element = document.createElement('div');
    this.element.className = 'pane-surface';
    this.element.tabIndex = 0;
    this.element.setAttribute('role', 'img');
    this.element.setAttribute(
      'aria-label',
      '3-D view of the mesh. Drag to turn, wheel to zoom; arrow keys turn, plus and minus zoom.',
    );
    parent.append(this.element);
    this.camera.up.set(0, 0, 1);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, this.element);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.invalidate());
    this.controls.addEventListener('start', () => {
      this.flight = null;
      this.fitted = false;
    });
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.pane = {
      element: this.element,
      resized: (width, height) => {
        const before = this.room();
        this.share = this.shareFor(height);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        if (this.fitted) {
          this.fit(false);
          return;
        }
        // What was in sight stays in sight when the pane becomes narrow or low.
        const { target } = this.controls;
        const nearer = before / this.room();
        this.camera.position.sub(target).multiplyScalar(nearer).add(target);
      },
      draw: (renderer) => {
        this.advanceFlight();
        this.fitDepth();
        renderer.render(this.scene, this.camera);
        for (const callback of this.afterDraw) callback();
      },
    };
    canvas.add(this.pane);
    this.fit(false);
  }

  /** Calls back after each drawing, until what it gives is called. */
  onDraw(callback: () => void): () => void {
    this.afterDraw.add(callback);
    return () => void this.afterDraw.delete(callback);
  }

  invalidate(): void {
    this.canvas.invalidate();
  }

  setBounds(points: Float32Array): void {
    this.bounds.makeEmpty();
    this.outline = points;
    const point = new Vector3();
    for (let i = 0; i < points.length; i += 3) this.bounds.expandByPoint(point.fromArray(points, i));
    this.fitDepth();
  }

  /** The whole body, from the direction of the current view. */
  fit(animated = true): void {
    const direction = this.camera.position.clone().sub(this.controls.target);
    if (direction.lengthSq() < 1e-6) direction.copy(threeQuarters);
    this.fitFrom(direction.normalize(), animated);
  }

  /** The whole body in the three-quarter view. */
  fitFromFront(): void {
    this.fitFrom(threeQuarters, false);
  }

  look(from: ViewDirection): void {
    const direction = new Vector3(...directions[from]);
    // Straight along the up axis the turn about it would be undefined.
    if (from === 'S' || from === 'I') direction.add(new Vector3(0, 0.001, 0)).normalize();
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.moveTo(this.controls.target.clone(), direction, distance, true);
  }

  /** So much around a point, from where the camera is or from a direction. */
  flyTo(point: Vector3, radius: number, direction = this.sight().direction): void {
    this.moveTo(point, direction, this.distanceFor(radius), true);
  }

  cameraNow(): Camera {
    const { position } = this.camera;
    return { position_mm: position.toArray(), target_mm: this.controls.target.toArray() };
  }

  /** Puts the camera there at once; a place that it cannot look from leaves it where it is. */
  placeCamera({ position_mm, target_mm }: Camera): void {
    const target = new Vector3(...target_mm);
    const away = new Vector3(...position_mm).sub(target);
    const distance = away.length();
    if (distance > 1e-3) this.moveTo(target, away.normalize(), distance, false);
  }

  add(object: Object3D): void {
    this.scene.add(object);
  }

  dispose(): void {
    this.controls.dispose();
    this.canvas.remove(this.pane);
    this.element.remove();
  }

  /** The nearest place in a direction from which a sample of the body's points is all in sight. */
  private fitFrom(direction: Vector3, animated: boolean): void {
    const centre = this.bounds.getCenter(new Vector3());
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    const tall = half * this.share;
    const wide = half * fitShare * this.camera.aspect;
    const step = 3 * Math.max(1, Math.floor(this.outline.length / 3 / 4000));
    const point = new Vector3();
    let distance = this.outline.length > 0 ? 0 : this.distanceFor(this.bounds.getSize(point).length() / 2);
    for (let i = 0; i < this.outline.length; i += step) {
      point.fromArray(this.outline, i).sub(centre);
      const reach = Math.max(Math.abs(point.dot(right)) / wide, Math.abs(point.dot(up)) / tall);
      distance = Math.max(distance, point.dot(direction) + reach);
    }
    this.moveTo(centre, direction, distance, animated);
    this.fitted = true;
  }

  /** How much of the view's height a body may take, or of its width where that is less. */
  private room(): number {
    return Math.min(this.share, fitShare * this.camera.aspect);
  }

  /** Above and below, what lies over a pane may ask for room: `--cards` of its style, in pixels. */
  private shareFor(height: number): number {
    const cards = Number(getComputedStyle(this.element).getPropertyValue('--cards'));
    return Math.min(fitShare, Math.max(fitShare / 2, 1 - (2 * cards) / height));
  }

  private distanceFor(radius: number): number {
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(1, this.camera.aspect);
    return (1.08 * radius) / (Math.sin(half) * narrow);
  }

  private sight(): Sight {
    const { target } = this.controls;
    const away = this.camera.position.clone().sub(target);
    return { target: target.clone(), direction: away.clone().normalize(), distance: away.length() };
  }

  private moveTo(target: Vector3, direction: Vector3, distance: number, animated: boolean): void {
    this.fitted = false;
    const still = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (animated && !still) {
      this.flight = {
        begin: performance.now(),
        from: this.sight(),
        to: { target: target.clone(), direction, distance },
      };
    } else {
      this.flight = null;
      this.controls.target.copy(target);
      this.camera.position.copy(target).addScaledVector(direction, distance);
      this.controls.update();
      this.fitDepth();
    }
    this.invalidate();
  }

  private advanceFlight(): void {
    if (!this.flight) return;
    const { begin, from, to } = this.flight;
    const t = Math.min(1, (performance.now() - begin) / flightMs);
    const eased = t * t * (3 - 2 * t);
    // Around the body, not through it.
    const turn = new Quaternion().slerp(
      new Quaternion().setFromUnitVectors(from.direction, to.direction),
      eased,
    );
    const distance = from.distance * (to.distance / from.distance) ** eased;
    this.controls.target.lerpVectors(from.target, to.target, eased);
    this.camera.position
      .copy(from.direction)
      .applyQuaternion(turn)
      .multiplyScalar(distance)
      .add(this.controls.target);
    this.camera.lookAt(this.controls.target);
    if (t >= 1) {
      this.flight = null;
      this.controls.update();
    }
    this.invalidate();
  }

  private fitDepth(): void {
    const sphere = this.bounds.getBoundingSphere(new Sphere());
    const distance = this.camera.position.distanceTo(sphere.center);
    this.camera.near = Math.max(sphere.radius / 200, distance - 3 * sphere.radius);
    this.camera.far = distance + 6 * sphere.radius;
    this.camera.updateProjectionMatrix();
  }

  private onKey(event: KeyboardEvent): void {
    const turn: Record<string, [number, number]> = {
      ArrowLeft: [-0.12, 0],
      ArrowRight: [0.12, 0],
      ArrowUp: [0, -0.12],
      ArrowDown: [0, 0.12],
    };
    const offset = this.camera.position.clone().sub(this.controls.target);
    const step = turn[event.key];
    if (step) {
      offset.applyAxisAngle(new Vector3(0, 0, 1), step[0]);
      const right = new Vector3().crossVectors(this.camera.up, offset).normalize();
      const tilted = offset.clone().applyAxisAngle(right, step[1]);
      if (Math.abs(tilted.clone().normalize().z) < 0.995) offset.copy(tilted);
    } else if (event.key === '+' || event.key === '=') {
      offset.multiplyScalar(0.88);
    } else if (event.key === '-') {
      offset.multiplyScalar(1 / 0.88);
    } else {
      return;
    }
    event.preventDefault();
    this.fitted = false;
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.invalidate();
  }
}
