import { DoubleSide, GLSL3, Mesh, RawShaderMaterial, BufferGeometry, type IUniform } from 'three';
import type { TetArrays } from '../../engine/contract';
import { imageColour } from '../frame/image_colour';
import { sectionVertex } from './tet_shaders';

/** Lines of one strength, light on dark labels and dark on light ones. */
const fragmentShader = /* glsl */ `
precision highp float;
${imageColour}
precision highp sampler2D;
uniform sampler2D centres;
uniform float strength;
in vec3 vCorner;
in vec3 vWorld;
flat in uint vElement;
layout(location = 0) out vec4 outColour;

void main() {
  // Where a side is no edge its corner's weight is one throughout, and its width nothing.
  vec3 width = max(fwidth(vCorner), 1e-6);
  vec3 near = smoothstep(0.15 * width, 0.85 * width, vCorner);
  float line = 1.0 - min(min(near.x, near.y), near.z);
  int tet = int(vElement);
  int label = int(texelFetch(centres, ivec2(tet & 2047, tet >> 11), 0).w);
  outColour = vec4(inkOn(imageColour(vWorld, label)), line * strength);
}`;

export type SectionEdges = Mesh<BufferGeometry, RawShaderMaterial>;

/** The edges of tetrahedra in the plane of the uniform `cutPlane`, over the image of these uniforms. */
export function sectionEdges(mesh: TetArrays, uniforms: Record<string, IUniform>): SectionEdges {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, 6 * mesh.labels.length);
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: sectionVertex,
    fragmentShader,
    side: DoubleSide,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms,
  });
  const edges: SectionEdges = new Mesh(geometry, material);
  edges.frustumCulled = false;
  edges.renderOrder = 1;
  return edges;
}
