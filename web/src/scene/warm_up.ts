import {
  BufferGeometry,
  Mesh,
  OrthographicCamera,
  Scene,
  WebGLRenderTarget,
  type RawShaderMaterial,
  type WebGLRenderer,
} from 'three';
import type { TetArrays } from '../engine/contract';
import { tetFaces } from '../geometry/tet_faces';
import { tetNeighbours } from '../geometry/tet_neighbours';
import { Contour } from './slices/contour';
import { elementMaterial } from './mesh/element_material';
import { nextTask } from './frame/tasks';
import { TetModel } from './mesh/tet_model';

function oneTet(): TetArrays {
  const points = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const bare = { points, tets: Uint32Array.from([0, 1, 2, 3]), labels: Uint16Array.from([1]) };
  const mesh = { ...bare, neighbours: tetNeighbours(bare.tets, 4) } as TetArrays;
  return { ...mesh, ...tetFaces(mesh) };
}

/**
 * Shaders are compiled by the driver beside the main thread, if they are asked for before they are used, and what is asked
 * of a program when it is first used waits for all drawing before it. So every program is made and used once before there
 * is anything to draw: first those of the first picture, which `ready` waits for, then the others. Kept for as long as
 * their programs are to live.
 */
export class WarmUp {
  readonly ready: Promise<void>;
  private readonly renderer: WebGLRenderer;
  private readonly disposals: (() => void)[] = [];

  constructor(renderer: WebGLRenderer, slices: RawShaderMaterial) {
    this.renderer = renderer;
    const looks = [{ smooth: true }, { smooth: false }, { smooth: false, ghost: true }];
    const surfaces = looks.map((look) => elementMaterial(look));
    this.disposals.push(() => surfaces.forEach((material) => material.dispose()));
    this.ready = this.use(surfaces.map((material) => new Mesh(new BufferGeometry(), material)));
    void this.ready.then(() => {
      const model = new TetModel(oneTet());
      const section = model.section(slices.uniforms);
      const contour = new Contour();
      this.disposals.push(() => {
        model.dispose();
        section.material.dispose();
        contour.dispose();
      });
      return this.use([
        new Mesh(new BufferGeometry(), slices),
        ...(model.group.children as Mesh[]),
        section,
        ...(contour.group.children as Mesh[]),
      ]);
    });
  }

  dispose(): void {
    for (const dispose of this.disposals) dispose();
  }

  /** Each in a task of its own. Never fails: what cannot be made now says so when it is drawn. */
  private async use(bodies: readonly Mesh[]): Promise<void> {
    const { renderer } = this;
    const camera = new OrthographicCamera();
    const target = new WebGLRenderTarget(1, 1);
    const all = new Scene();
    all.add(...bodies);
    try {
      if (renderer.extensions.has('KHR_parallel_shader_compile')) await renderer.compileAsync(all, camera);
      else renderer.compile(all, camera);
      for (const body of bodies) {
        await nextTask();
        const scene = new Scene();
        scene.add(body);
        body.visible = true;
        body.frustumCulled = false;
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        renderer.setRenderTarget(null);
      }
    } catch {
      return;
    } finally {
      target.dispose();
    }
  }
}
