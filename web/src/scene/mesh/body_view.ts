import { BufferAttribute, BufferGeometry, Group, Mesh, type RawShaderMaterial } from 'three';
import type { TetArrays } from '../../engine/contract';
import type { Faces } from '../../geometry/faces';
import { noClip } from '../frame/surroundings';
import { elementMaterial } from './element_material';
import type { SurfaceBody } from './colouring';
import { TetModel, type Plane } from './tet_model';

type SurfaceMesh = Mesh<BufferGeometry, RawShaderMaterial>;

function geometryOf(faces: Faces): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(faces.positions, 3));
  geometry.setAttribute('colour', new BufferAttribute(faces.colours, 3, true));
  if (faces.normals) geometry.setAttribute('normal', new BufferAttribute(faces.normals, 3));
  return geometry;
}

/** One body at a time: a surface, a tetrahedral mesh, or the outline of a surface. */
export class BodyView {
  readonly group = new Group();
  model: TetModel | null = null;
  /** The triangle of the surface that each face is. */
  owners: Uint32Array | null = null;
  private mesh: TetArrays | null = null;
  private faces: Faces | null = null;
  private readonly opaque = {
    flat: elementMaterial({ smooth: false }),
    smooth: elementMaterial({ smooth: true }),
  };
  private readonly glass = elementMaterial({ smooth: false, ghost: true });
  private readonly surface: SurfaceMesh = new Mesh(new BufferGeometry(), this.opaque.flat);
  private look: [number, number] = [0.55, 0.1];
  private seeThrough = false;

  constructor() {
    this.surface.frustumCulled = false;
    this.surface.visible = false;
    this.group.add(this.surface);
  }

  /** What a click may hit. */
  get pickable(): SurfaceMesh[] {
    if (this.model) return this.model.pickable;
    return this.owners ? [this.surface] : [];
  }

  clear(): void {
    this.surface.visible = false;
    this.owners = null;
    this.dropModel();
  }

  showSurface({ faces }: SurfaceBody, outline = false): void {
    this.dropModel();
    if (this.faces !== faces) {
      this.faces = faces;
      this.surface.geometry.dispose();
      this.surface.geometry = geometryOf(faces);
    }
    this.surface.material = outline ? this.glass : faces.normals ? this.opaque.smooth : this.opaque.flat;
    this.surface.visible = true;
    this.owners = outline ? null : faces.owners;
  }

  /** The model of the mesh, unless it is shown already. */
  showTets(mesh: TetArrays): TetModel | null {
    this.surface.visible = false;
    this.owners = null;
    if (this.mesh === mesh) return null;
    this.dropModel();
    this.mesh = mesh;
    this.model = new TetModel(mesh);
    this.model.setLook(...this.look);
    this.model.setSeeThrough(this.seeThrough);
    this.group.add(this.model.group);
    return this.model;
  }

  setPlane(plane: Plane | null): void {
    this.model?.setPlane(plane);
    for (const material of [this.opaque.flat, this.opaque.smooth]) {
      const clip = material.uniforms.clipPlane.value as typeof noClip;
      if (plane) clip.set(plane.normal[0], plane.normal[1], plane.normal[2], plane.offset);
      else clip.copy(noClip);
    }
  }

  setLook(edges: boolean, ghostOpacity: number): void {
    this.look = [edges ? 0.55 : 0, ghostOpacity];
    this.model?.setLook(...this.look);
    this.opaque.flat.uniforms.edgeStrength.value = edges ? 0.55 : 0;
    this.opaque.smooth.uniforms.edgeStrength.value = edges ? 0.35 : 0;
    this.glass.uniforms.opacity.value = ghostOpacity;
  }

  /** Tetrahedra are an outline around what is drawn within them. */
  setSeeThrough(on: boolean): void {
    this.seeThrough = on;
    this.model?.setSeeThrough(on);
  }

  dispose(): void {
    this.clear();
    this.surface.geometry.dispose();
    for (const material of [this.opaque.flat, this.opaque.smooth, this.glass]) material.dispose();
  }

  private dropModel(): void {
    if (!this.model) return;
    this.group.remove(this.model.group);
    this.model.dispose();
    this.model = null;
    this.mesh = null;
  }
}
