import {
  BufferGeometry,
  Color,
  DataTexture,
  DoubleSide,
  GLSL3,
  Group,
  Mesh,
  RawShaderMaterial,
  Vector2,
  Vector3,
  Vector4,
  type IUniform,
  type Texture,
  type WebGLRenderer,
} from 'three';
import type { TetArrays } from '../../engine/contract';
import { chosenBit, nearBit, shownBit } from '../../geometry/tet_faces';
import { noClip } from '../frame/surroundings';
import { shadingUniforms } from './element_material';
import type { TetPaint } from './colouring';
import { nextTask } from '../frame/tasks';
import { shadingFragment } from '../frame/shading';
import { sectionEdges, type SectionEdges } from './section_edges';
import { facesVertex, sectionVertex } from './tet_shaders';
import {
  arrayTexture,
  labelTexture,
  paletteTexture,
  pointTexture,
  refill,
  scaleTexture,
} from '../frame/textures';

export type TetDrawing = Mesh<BufferGeometry, RawShaderMaterial>;

/** normal . p <= offset is kept; flat cuts go through elements, others leave them whole. */
export interface Plane {
  normal: readonly number[];
  offset: number;
  flat: boolean;
}

const paintCodes = { label: 0, scale: 1, given: 2, points: 4, parts: 5, nodal: 6 } as const;
const plainCode = 3;

/** All that is shown; some of it, with an outline of the rest; or one tet, with a veil of those near it. */
export type Choice = 'all' | 'some' | 'one';

/**
 * A tetrahedral mesh on the graphics card. Its arrays are uploaded once; cuts, choices, colours and pulling apart
 * change uniforms, or one byte or number a tet.
 */
export class TetModel {
  readonly group = new Group();
  readonly largest: number;
  private readonly mesh: TetArrays;
  private readonly shared;
  private readonly solid: TetDrawing;
  private readonly cap: TetDrawing;
  private readonly ghost: TetDrawing;
  private readonly veil: TetDrawing;
  /** Where the body was before it moved. */
  private readonly outline: TetDrawing;
  private plane: Plane | null = null;
  private choice: Choice = 'all';
  private seeThrough = false;
  private hides = false;
  private disposed = false;

  constructor(mesh: TetArrays) {
    this.mesh = mesh;
    const ways = new Map<number, Float32Array>();
    for (let i = 0; i < mesh.ways.length; i += 4) ways.set(mesh.ways[i], mesh.ways.subarray(i + 1, i + 4));
    this.largest = Math.max(0, ...ways.keys());
    const { faces, centres, extents, tets, neighbours } = mesh;
    this.shared = {
      points: { value: pointTexture(mesh.points) },
      rest: { value: pointTexture(mesh.points) },
      centres: { value: arrayTexture(centres, 4) },
      tets: { value: arrayTexture(tets, 4) },
      neighbours: { value: arrayTexture(neighbours, 4) },
      faces: { value: arrayTexture(faces, 1) },
      mask: { value: arrayTexture(new Uint8Array(mesh.labels.length).fill(shownBit | chosenBit), 1) },
      values: { value: arrayTexture(new Float32Array(1), 1) },
      palette: { value: paletteTexture(this.largest, () => '#969696', new Set()) },
      scale: { value: scaleTexture('viridis') },
      offsets: { value: labelTexture(this.largest, ways) },
      counts: { value: new Vector2(extents[0], extents[1]) },
      reach: { value: extents[2] },
      range: { value: new Vector2(0, 1) },
      bands: { value: 0 },
      period: { value: 0 },
      explode: { value: 0 },
      apart: { value: false },
      plain: { value: new Color(0.59, 0.59, 0.59) },
    };
    this.solid = this.drawing(facesVertex, { need: chosenBit });
    this.cap = this.drawing(sectionVertex, { need: chosenBit });
    this.ghost = this.drawing(facesVertex, { need: shownBit, ghost: true });
    this.veil = this.drawing(facesVertex, { need: nearBit, ghost: true });
    // The face of a cut is no surface of the body.
    this.cap.material.uniforms.shelter.value = -1;
    this.cap.geometry.setDrawRange(0, 6 * mesh.labels.length);
    this.ghost.geometry.setDrawRange(0, 3 * extents[0]);
    this.veil.geometry.setDrawRange(0, 3 * faces.length);
    this.ghost.renderOrder = this.veil.renderOrder = 1;
    this.outline = this.drawing(facesVertex, { need: shownBit, ghost: true });
    this.outline.material.uniforms.points = this.shared.rest;
    this.outline.geometry.setDrawRange(0, 3 * extents[0]);
    this.outline.renderOrder = 1;
    this.outline.visible = false;
    this.group.add(this.solid, this.cap, this.ghost, this.veil, this.outline);
    this.update();
  }

  /** Takes the textures to the graphics card one a task, since all of them at once would hold up the page. */
  async upload(renderer: WebGLRenderer): Promise<void> {
    this.group.visible = false;
    for (const { value } of Object.values(this.shared)) {
      if (this.disposed) return;
      if (!(value instanceof DataTexture)) continue;
      renderer.initTexture(value);
      await nextTask();
    }
    this.group.visible = true;
  }

  /** What a click may hit. */
  get pickable(): TetDrawing[] {
    return this.group.visible ? [this.solid, this.cap, this.veil].filter((one) => one.visible) : [];
  }

  /** The edges of its section with a slice, over an image of these uniforms. */
  section(image: Record<string, IUniform>): SectionEdges {
    return sectionEdges(this.mesh, {
      ...this.shared,
      ...image,
      // A slice shows the mesh where it is, not where its labels are pulled to.
      explode: { value: 0 },
      need: { value: chosenBit },
      paint: { value: plainCode },
      cutPlane: { value: noClip.clone() },
      strength: { value: 1 },
    });
  }

  setMask(mask: Uint8Array, choice: Choice, hides: boolean): void {
    this.replace('mask', arrayTexture(mask, 1));
    this.choice = choice;
    this.hides = hides;
    this.update();
  }

  setPaint(paint: TetPaint, colour: (label: number) => string): void {
    this.replace('palette', paletteTexture(this.largest, colour, new Set()));
    if (paint.kind !== 'label') this.replace('values', arrayTexture(paint.values, 1));
    if ('legend' in paint) {
      this.replace('scale', scaleTexture(paint.legend.map));
      const { lo, hi, bands, map } = paint.legend;
      // Of a single value there is one colour.
      this.shared.range.value.set(lo, hi > lo ? hi : lo + 1);
      this.shared.bands.value = bands ?? 0;
      this.shared.period.value = map === 'cycle' ? hi - lo : 0;
    }
    for (const one of [this.solid, this.cap, this.veil])
      one.material.uniforms.paint.value = paintCodes[paint.kind];
  }

  /** Other values of the same elements, as the paint that is set has them. */
  setValues(values: Float32Array): void {
    refill(this.shared.values.value, values);
  }

  /** Moves each point by three numbers, or puts all back. */
  setMoves(moves: Float32Array | null, outlined: boolean): void {
    const { points, extents } = this.mesh;
    this.outline.visible = outlined;
    const texture = this.shared.points.value;
    const moved = texture.image.data as unknown as Float32Array;
    let most = 0;
    for (let i = 0, j = 0; i < points.length; i += 3, j += 4) {
      const [x, y, z] = moves ? [moves[i], moves[i + 1], moves[i + 2]] : [0, 0, 0];
      moved[j] = points[i] + x;
      moved[j + 1] = points[i + 1] + y;
      moved[j + 2] = points[i + 2] + z;
      most = Math.max(most, x * x + y * y + z * z);
    }
    texture.needsUpdate = true;
    this.shared.reach.value = extents[2] + Math.sqrt(most);
  }

  setPlane(plane: Plane | null): void {
    this.plane = plane;
    this.update();
  }

  setExplode(amount: number): void {
    this.shared.explode.value = amount;
    this.shared.apart.value = amount > 0;
    this.update();
  }

  /** Only an outline is drawn; what a click hits stays. */
  setSeeThrough(on: boolean): void {
    this.seeThrough = on;
    this.update();
  }

  setLook(edgeStrength: number, ghostOpacity: number): void {
    for (const one of [this.solid, this.cap]) one.material.uniforms.edgeStrength.value = edgeStrength;
    for (const one of [this.ghost, this.outline]) one.material.uniforms.opacity.value = ghostOpacity;
    this.veil.material.uniforms.opacity.value = 2.2 * ghostOpacity;
    this.veil.material.uniforms.edgeStrength.value = edgeStrength;
  }

  dispose(): void {
    this.disposed = true;
    for (const { value } of Object.values(this.shared)) (value as Partial<Texture>).dispose?.();
    for (const one of [this.solid, this.cap, this.ghost, this.veil, this.outline]) {
      one.geometry.dispose();
      one.material.dispose();
    }
  }

  private replace(
    name: 'mask' | 'palette' | 'values' | 'scale',
    texture: (typeof this.shared)['mask']['value'],
  ) {
    this.shared[name].value.dispose();
    this.shared[name].value = texture;
  }

  private drawing(vertexShader: string, look: { need: number; ghost?: boolean }): TetDrawing {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader: shadingFragment,
      defines: { FIELD: 1 },
      side: DoubleSide,
      transparent: look.ghost === true,
      depthWrite: !look.ghost,
      uniforms: {
        ...this.shared,
        ...shadingUniforms(look.ghost ?? false),
        need: { value: look.need },
        cutPlane: { value: noClip.clone() },
        paint: { value: look.ghost ? plainCode : paintCodes.label },
      },
    });
    const mesh: TetDrawing = new Mesh(new BufferGeometry(), material);
    mesh.frustumCulled = false;
    return mesh;
  }

  /** Only the faces that can be seen are drawn: index ranges, whole cuts and choices apart. */
  private update(): void {
    const { extents, faces } = this.mesh;
    const { plane } = this;
    const at = plane ? new Vector4(...new Vector3(...plane.normal).toArray(), plane.offset) : noClip;
    const partly = this.choice !== 'all';
    const every = partly || (plane !== null && !plane.flat);
    const some = this.hides || this.shared.apart.value;
    const count = every ? faces.length : some ? extents[1] : extents[0];
    this.solid.geometry.setDrawRange(0, 3 * count);
    // What stands alone is sheltered by nothing.
    this.solid.material.uniforms.shelter.value = partly || this.shared.apart.value ? 0 : 1;
    this.solid.material.uniforms.cutPlane.value.copy(plane && !plane.flat ? at : noClip);
    this.solid.material.uniforms.clipPlane.value.copy(plane?.flat ? at : noClip);
    this.cap.visible = plane?.flat ?? false;
    this.cap.material.uniforms.cutPlane.value.copy(at);
    this.ghost.visible = partly || this.seeThrough;
    this.veil.visible = this.choice === 'one';
    for (const one of [this.solid, this.cap]) one.material.visible = !this.seeThrough;
  }
}
