import {
  Color,
  GLSL3,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  LineSegments,
  RawShaderMaterial,
  Vector4,
} from 'three';

const vertexShader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec4 cutPlane;
in vec3 a, b, c;

void main() {
  vec3 d = vec3(dot(cutPlane.xyz, a), dot(cutPlane.xyz, b), dot(cutPlane.xyz, c)) - cutPlane.w;
  bvec3 above = greaterThan(d, vec3(0.0));
  if (above.x == above.y && above.y == above.z) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  // The corner that is alone on its side; the plane crosses the two edges that meet there.
  bool first = gl_VertexID % 2 == 0;
  vec3 lone = above.y == above.z ? a : above.x == above.z ? b : c;
  float away = above.y == above.z ? d.x : above.x == above.z ? d.y : d.z;
  vec3 other = above.y == above.z ? (first ? b : c) : above.x == above.z ? (first ? a : c) : (first ? a : b);
  float beyond = dot(cutPlane.xyz, other) - cutPlane.w;
  vec3 p = mix(lone, other, away / (away - beyond));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec3 colour;
out vec4 outColour;
void main() { outColour = vec4(colour, 0.9); }`;

export type Contour = LineSegments<InstancedBufferGeometry, RawShaderMaterial>;

/** Triangles, nine numbers each, for any number of contours. */
export function contourGeometry(positions: Float32Array): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  const buffer = new InstancedInterleavedBuffer(positions, 9);
  ['a', 'b', 'c'].forEach((name, corner) =>
    geometry.setAttribute(name, new InterleavedBufferAttribute(buffer, 3, 3 * corner)),
  );
  geometry.setDrawRange(0, 2);
  geometry.instanceCount = positions.length / 9;
  return geometry;
}

/** The lines in which the plane of the uniform `cutPlane` meets the triangles. */
export function contourOf(geometry: InstancedBufferGeometry): Contour {
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: { cutPlane: { value: new Vector4(0, 0, 1, 0) }, colour: { value: new Color(0.05, 0.07, 0.1) } },
  });
  const lines: Contour = new LineSegments(geometry, material);
  lines.frustumCulled = false;
  return lines;
}
