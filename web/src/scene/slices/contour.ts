import {
  BufferGeometry,
  Color,
  GLSL3,
  LineSegments,
  RawShaderMaterial,
  Vector4,
  type DataTexture,
} from 'three';

const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform sampler2D triangles;
uniform vec4 cutPlane;

float number(int i) { return texelFetch(triangles, ivec2(i & 2047, i >> 11), 0).r; }
vec3 corner(int i) { return vec3(number(i), number(i + 1), number(i + 2)); }

void main() {
  int first = 9 * (gl_VertexID / 2);
  vec3 p[3] = vec3[3](corner(first), corner(first + 3), corner(first + 6));
  vec3 d = vec3(dot(cutPlane.xyz, p[0]), dot(cutPlane.xyz, p[1]), dot(cutPlane.xyz, p[2])) - cutPlane.w;
  bvec3 above = greaterThan(d, vec3(0.0));
  if (above.x == above.y && above.y == above.z) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  // The corner that is alone on its side; the plane crosses the two edges that meet there.
  int lone = above.y == above.z ? 0 : above.x == above.z ? 1 : 2;
  int other = (lone + 1 + gl_VertexID % 2) % 3;
  vec3 place = mix(p[lone], p[other], d[lone] / (d[lone] - d[other]));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec3 colour;
out vec4 outColour;
void main() { outColour = vec4(colour, 0.9); }`;

export type Contour = LineSegments<BufferGeometry, RawShaderMaterial>;

/** The lines in which the plane of the uniform `cutPlane` meets triangles, nine numbers each, of a texture. */
export function contourOf(triangles: DataTexture, count: number): Contour {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, 2 * count);
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: {
      triangles: { value: triangles },
      cutPlane: { value: new Vector4(0, 0, 1, 0) },
      colour: { value: new Color(0.05, 0.07, 0.1) },
    },
  });
  const lines: Contour = new LineSegments(geometry, material);
  lines.frustumCulled = false;
  material.addEventListener('dispose', () => triangles.dispose());
  return lines;
}
