import { Scene } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Canvas, Pane } from './canvas';
import type { Viewer } from './viewer';

/** A second pane that looks at a scene of its own with the camera of the first. */
export class Twin {
  readonly scene = new Scene();
  private readonly controls: OrbitControls;
  private readonly canvas: Canvas;
  private readonly pane: Pane;

  constructor(canvas: Canvas, viewer: Viewer, parent: HTMLElement) {
    this.canvas = canvas;
    const element = document.createElement('div');
    element.className = 'pane-surface';
    element.setAttribute('role', 'img');
    element.setAttribute(
      'aria-label',
      'The pinned run, seen from the same side. Drag to turn, wheel to zoom.',
    );
    parent.append(element);
    this.controls = new OrbitControls(viewer.camera, element);
    this.controls.target = viewer.controls.target;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => canvas.invalidate());
    this.pane = {
      element,
      resized: () => undefined,
      draw: (renderer) => renderer.render(this.scene, viewer.camera),
    };
    canvas.add(this.pane);
  }

  dispose(): void {
    this.controls.dispose();
    this.canvas.remove(this.pane);
  }
}
