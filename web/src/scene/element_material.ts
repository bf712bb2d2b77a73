import { Color, DoubleSide, GLSL3, RawShaderMaterial, Vector4 } from 'three';

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
out vec3 vView;
out vec3 vWorld;
out vec3 vCorner;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vView = view.xyz;
  vWorld = position;
  vColour = colour;
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
#ifdef SMOOTH
  vNormal = normalMatrix * normal;
#endif
  gl_Position = projectionMatrix * view;
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec4 clipPlane;
uniform float edgeStrength;
uniform vec3 edgeColour;
uniform float opacity;
in vec3 vColour;
in vec3 vView;
in vec3 vWorld;
in vec3 vCorner;
#ifdef SMOOTH
in vec3 vNormal;
#endif
out vec4 outColour;
void main() {
  if (dot(clipPlane.xyz, vWorld) > clipPlane.w) discard;
#ifdef SMOOTH
  vec3 n = normalize(vNormal);
#else
  vec3 n = normalize(cross(dFdx(vView), dFdy(vView)));
#endif
  vec3 toEye = normalize(-vView);
  if (dot(n, toEye) < 0.0) n = -n;
  float key = max(dot(n, normalize(vec3(0.35, 0.55, 0.75))), 0.0);
  float fill = max(dot(n, normalize(vec3(-0.6, -0.1, 0.5))), 0.0);
  float sky = 0.5 + 0.5 * n.y;
  vec3 base = vColour * vColour;
  vec3 lit = base * (0.3 + 0.16 * sky + 0.66 * key + 0.22 * fill);
  lit += 0.05 * pow(max(dot(n, normalize(toEye + vec3(0.35, 0.55, 0.75))), 0.0), 24.0);
  vec3 width = fwidth(vCorner);
  vec3 near = smoothstep(vec3(0.0), width * 1.1, vCorner);
  float line = 1.0 - min(min(near.x, near.y), near.z);
  // Edges closer together than a few pixels would turn the body black; let them fade out.
  float crowd = max(max(width.x, width.y), width.z);
  line *= edgeStrength * (1.0 - smoothstep(0.12, 0.45, crowd));
  vec3 shaded = sqrt(clamp(lit, 0.0, 1.0));
  outColour = vec4(mix(shaded, edgeColour, line), opacity);
}`;

/** A plane that clips nothing. */
export const noClip = new Vector4(0, 0, 0, 1);

/**
 * Faces with a colour each, soft light from the viewer's shoulder, and crisp element edges drawn from the
 * barycentric place in the face. Geometry must not be indexed: three corners in a row are one face.
 */
export function elementMaterial(options: { smooth: boolean; ghost?: boolean }): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    defines: options.smooth ? { SMOOTH: 1 } : {},
    side: DoubleSide,
    transparent: options.ghost ?? false,
    depthWrite: !options.ghost,
    uniforms: {
      clipPlane: { value: noClip.clone() },
      edgeStrength: { value: options.ghost ? 0 : 0.55 },
      edgeColour: { value: new Color(0.05, 0.07, 0.1) },
      opacity: { value: options.ghost ? 0.1 : 1 },
    },
  });
}
