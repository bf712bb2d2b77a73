import {
  Color,
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  BufferAttribute,
  Mesh,
  RawShaderMaterial,
} from 'three';
import type { Pieces } from '../../geometry/fibres';
import { shadingFragment } from '../frame/shading';
import { noClip } from '../frame/surroundings';
import { shadingUniforms } from './element_material';

/** Each piece is a tube with pointed ends; whole pieces lie on one side of a cut. */
const vertexShader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform mat3 normalMatrix;
uniform vec4 cutPlane;
uniform float radius, explode, nearer;
/** Across the tube in units of its radius, and 0 or 1 for the end. */
in vec3 position;
in vec3 start, end, colour, away;
out vec3 vColour;
flat out uint vElement;
out vec3 vView;
out vec3 vWorld;
out vec3 vCorner;
out vec3 vNormal;
void main() {
  vec3 middle = 0.5 * (start + end);
  vec3 along = normalize(end - start);
  vec3 side = normalize(cross(along, abs(along.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec3 round_ = position.x * side + position.y * cross(along, side);
  bool tip = position.x == 0.0 && position.y == 0.0;
  vec3 outwards = tip ? (2.0 * position.z - 1.0) * along : round_;
  vec4 view = modelViewMatrix * vec4(mix(start, end, position.z) + radius * outwards + explode * away, 1.0);
  // Towards the eye, so that pieces just below a face are seen on it.
  view.xyz *= 1.0 - min(0.5, nearer / length(view.xyz));
  vView = view.xyz;
  vWorld = middle;
  vColour = colour;
  vElement = 0u;
  vCorner = vec3(0.0);
  vNormal = normalMatrix * outwards;
  gl_Position = dot(cutPlane.xyz, middle) > cutPlane.w ? vec4(0.0, 0.0, 2.0, 1.0) : projectionMatrix * view;
}`;

const sides = 6;

/** Two rings and two tips. */
function tube(): { corners: Float32Array; triangles: number[] } {
  const corners: number[] = [];
  for (const end of [0, 1])
    for (let i = 0; i < sides; i++) {
      const angle = (2 * Math.PI * i) / sides;
      corners.push(Math.cos(angle), Math.sin(angle), end);
    }
  corners.push(0, 0, 0, 0, 0, 1);
  const triangles: number[] = [];
  for (let i = 0; i < sides; i++) {
    const [a, b] = [i, (i + 1) % sides];
    triangles.push(
      a,
      b,
      a + sides,
      b,
      b + sides,
      a + sides,
      b,
      a,
      2 * sides,
      a + sides,
      b + sides,
      2 * sides + 1,
    );
  }
  return { corners: Float32Array.from(corners), triangles };
}

export type FibreDrawing = Mesh<InstancedBufferGeometry, RawShaderMaterial>;

/** Puts the ends of all pieces elsewhere, six numbers each. */
export function setEnds({ geometry }: FibreDrawing, ends: Float32Array): void {
  const { data } = geometry.getAttribute('start') as InterleavedBufferAttribute;
  data.set(ends);
  data.needsUpdate = true;
}

/** Pieces of fibres, with three bytes of colour each and the way in which each is pulled apart. */
export function fibreDrawing(
  pieces: Pieces,
  colours: Uint8Array,
  ways: Float32Array,
  radius: number,
): FibreDrawing {
  const { corners, triangles } = tube();
  const geometry = new InstancedBufferGeometry();
  geometry.instanceCount = pieces.tets.length;
  geometry.setIndex(triangles);
  geometry.setAttribute('position', new BufferAttribute(corners, 3));
  const ends = new InstancedInterleavedBuffer(pieces.ends.slice(), 6);
  geometry.setAttribute('start', new InterleavedBufferAttribute(ends, 3, 0));
  geometry.setAttribute('end', new InterleavedBufferAttribute(ends, 3, 3));
  geometry.setAttribute('colour', new InstancedBufferAttribute(colours, 3, true));
  geometry.setAttribute('away', new InstancedBufferAttribute(ways, 3));
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader: shadingFragment,
    defines: { SMOOTH: 1 },
    uniforms: {
      ...shadingUniforms(false),
      edgeStrength: { value: 0 },
      shelter: { value: 0 },
      edgeColour: { value: new Color(0, 0, 0) },
      cutPlane: { value: noClip.clone() },
      radius: { value: radius },
      explode: { value: 0 },
      nearer: { value: 0 },
    },
  });
  const mesh: FibreDrawing = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}
