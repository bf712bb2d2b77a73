import {
  RawShaderMaterial,
  RGBAIntegerFormat,
  Scene,
  UnsignedIntType,
  Vector3,
  WebGLRenderTarget,
  type BufferGeometry,
  type Mesh,
  type PerspectiveCamera,
  type WebGLRenderer,
} from 'three';

export interface Hit {
  element: number;
  /** Where, in mm, before any pulling apart. */
  point: Vector3;
}

type Pickable = Mesh<BufferGeometry, RawShaderMaterial>;

const variants = new WeakMap<RawShaderMaterial, RawShaderMaterial>();

/** The same material, writing numbers of elements instead of colours. */
function pickingVariant(material: RawShaderMaterial): RawShaderMaterial {
  let variant = variants.get(material);
  if (!variant) {
    variant = new RawShaderMaterial({
      glslVersion: material.glslVersion,
      vertexShader: material.vertexShader,
      fragmentShader: material.fragmentShader,
      defines: { ...material.defines, PICK: 1 },
      side: material.side,
      uniforms: material.uniforms,
    });
    variants.set(material, variant);
    const made = variant;
    material.addEventListener('dispose', () => made.dispose());
  }
  return variant;
}

/** What is seen at a place of the pane, in pixels from its top left: drawn once more, into one pixel. */
export function pickAt(
  renderer: WebGLRenderer,
  camera: PerspectiveCamera,
  meshes: readonly Pickable[],
  pane: { width: number; height: number },
  at: { x: number; y: number },
): Hit | null {
  const target = new WebGLRenderTarget(1, 1, { format: RGBAIntegerFormat, type: UnsignedIntType });
  const scene = new Scene();
  const view = camera.clone();
  view.setViewOffset(pane.width, pane.height, Math.floor(at.x), Math.floor(at.y), 1, 1);
  const before = meshes.map((mesh) => ({ mesh, parent: mesh.parent, material: mesh.material }));
  for (const mesh of meshes) {
    mesh.material = pickingVariant(mesh.material);
    scene.add(mesh);
  }
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, view);
  const pixel = new Uint32Array(4);
  renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
  renderer.setRenderTarget(null);
  target.dispose();
  for (const { mesh, parent, material } of before) {
    mesh.material = material;
    parent?.add(mesh);
  }
  if (pixel[0] === 0) return null;
  const [x, y, z] = new Float32Array(pixel.buffer, 4, 3);
  return { element: pixel[0] - 1, point: new Vector3(x, y, z) };
}
