import { WebGLRenderer } from 'three';

/** A part of the canvas with a scene of its own. Its element takes the events; what it shows is drawn behind it. */
export interface Pane {
  element: HTMLElement;
  resized(width: number, height: number): void;
  draw(renderer: WebGLRenderer): void;
}

/** One canvas and one graphics context for all panes. Draws only when something changed. */
export class Canvas {
  readonly renderer: WebGLRenderer;
  private readonly container: HTMLElement;
  private readonly observer: ResizeObserver;
  private readonly panes = new Set<Pane>();
  private frame = 0;
  private held = false;

  constructor(container: HTMLElement) {
    this.container = container;
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, powerPreference: 'high-performance' });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setScissorTest(true);
    // Asking whether a shader compiled waits for it.
    this.renderer.debug.checkShaderErrors = import.meta.env.DEV;
    this.renderer.domElement.className = 'view-canvas';
    this.renderer.domElement.setAttribute('aria-hidden', 'true');
    // The graphics driver may take it away and give it back.
    this.renderer.domElement.addEventListener('webglcontextrestored', () => this.invalidate());
    container.append(this.renderer.domElement);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(container);
  }

  add(pane: Pane): void {
    this.panes.add(pane);
    this.observer.observe(pane.element);
  }

  remove(pane: Pane): void {
    this.panes.delete(pane);
    this.observer.unobserve(pane.element);
    this.invalidate();
  }

  /** Draws nothing before something has come: drawing with a shader that is not compiled waits for it. */
  holdUntil(ready: Promise<void>): void {
    this.held = true;
    void ready.then(() => {
      this.held = false;
      this.invalidate();
    });
  }

  invalidate(): void {
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.draw();
    });
  }

  /** Draws at once, so that the canvas can be read in the same turn. */
  draw(): void {
    if (this.held) return;
    const frame = this.container.getBoundingClientRect();
    for (const pane of this.panes) {
      const box = pane.element.getBoundingClientRect();
      if (box.width === 0 || box.height === 0) continue;
      const place = [box.left - frame.left, frame.bottom - box.bottom, box.width, box.height] as const;
      this.renderer.setViewport(...place);
      this.renderer.setScissor(...place);
      pane.draw(this.renderer);
    }
  }

  /** Draws with more pixels, hands the canvas over, and goes back to those of the screen. */
  drawFiner(pixels: number, take: (canvas: HTMLCanvasElement) => void): void {
    const usual = this.renderer.getPixelRatio();
    this.renderer.setPixelRatio(pixels);
    this.draw();
    take(this.renderer.domElement);
    this.renderer.setPixelRatio(usual);
    this.draw();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.observer.disconnect();
    this.renderer.dispose();
    // A page has only so many contexts, and the collector takes its time.
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.container;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight);
    // What a hidden pane last drew would stay.
    this.renderer.setScissor(0, 0, clientWidth, clientHeight);
    this.renderer.clear();
    for (const { element, resized } of this.panes) {
      if (element.clientWidth > 0 && element.clientHeight > 0)
        resized(element.clientWidth, element.clientHeight);
    }
    this.draw();
  }
}
