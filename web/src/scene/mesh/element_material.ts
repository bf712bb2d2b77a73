import { Color, DoubleSide, GLSL3, RawShaderMaterial } from 'three';
import { shadingFragment } from '../frame/shading';
import { noClip, surroundings } from '../frame/surroundings';

const vertexShader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 position;
in vec3 colour;
#ifdef SMOOTH
in vec3 normal;
uniform mat3 normalMatrix;
out vec3 vNormal;
#endif
out vec3 vColour;
flat out uint vElement;
out vec3 vView;
out vec3 vWorld;
out vec3 vCorner;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vView = view.xyz;
  vWorld = position;
  vColour = colour;
  vElement = uint(gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
#ifdef SMOOTH
  vNormal = normalMatrix * normal;
#endif
  gl_Position = projectionMatrix * view;
}`;

/** Uniforms of the shared fragment stage. */
export function shadingUniforms(ghost: boolean) {
  return {
    ...surroundings,
    clipPlane: { value: noClip.clone() },
    shelter: { value: ghost ? 0 : 1 },
    edgeStrength: { value: ghost ? 0 : 0.55 },
    edgeColour: { value: new Color(0.05, 0.07, 0.1) },
    opacity: { value: ghost ? 0.1 : 1 },
  };
}

/** Faces with a colour each. Geometry must not be indexed: three corners in a row are one face. */
export function elementMaterial(options: { smooth: boolean; ghost?: boolean }): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader: shadingFragment,
    defines: options.smooth ? { SMOOTH: 1 } : {},
    side: DoubleSide,
    transparent: options.ghost ?? false,
    depthWrite: !options.ghost,
    uniforms: shadingUniforms(options.ghost ?? false),
  });
}
