import {
  BufferAttribute,
  GLSL3,
  Group,
  InstancedInterleavedBuffer,
  InstancedBufferGeometry,
  InterleavedBufferAttribute,
  Mesh,
  RawShaderMaterial,
  Vector2,
  Vector4,
} from 'three';
import { sectionLines } from '../../geometry/section';

const vertexShader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 pane;
uniform float halfWidth;
in vec3 position, begin, end;

void main() {
  vec4 a = projectionMatrix * modelViewMatrix * vec4(begin, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
  vec2 way = (b.xy - a.xy) * pane;
  vec2 along = length(way) > 0.0 ? normalize(way) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  // A little beyond its ends, so that lines that meet leave no gap.
  vec2 away = halfWidth * (position.x * along + position.y * across);
  gl_Position = vec4((position.x < 0.0 ? a.xy : b.xy) + 2.0 * away / pane, 0.0, 1.0);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec4 colour;
out vec4 outColour;
void main() { outColour = colour; }`;

/** From half a line to the other: two triangles. */
const corners = Float32Array.from([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0]);

/** A dark line in a pale one is seen on every colour. */
const strokes = [
  { halfWidth: 1.6, grey: 1, opacity: 0.6 },
  { halfWidth: 0.7, grey: 0.06, opacity: 1 },
];

function strokeMaterial({ halfWidth, grey, opacity }: (typeof strokes)[number], pane: Vector2) {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: {
      pane: { value: pane },
      halfWidth: { value: halfWidth },
      colour: { value: new Vector4(grey, grey, grey, opacity) },
    },
  });
}

/** The lines in which a slice cuts triangles. */
export class Contour {
  readonly group = new Group();
  private readonly pane = new Vector2(1, 1);
  private readonly geometry = new InstancedBufferGeometry();
  private triangles: Float32Array = new Float32Array(0);

  constructor() {
    this.geometry.setAttribute('position', new BufferAttribute(corners, 3));
    this.group.add(
      ...strokes.map((stroke, i) => {
        const lines = new Mesh(this.geometry, strokeMaterial(stroke, this.pane));
        lines.frustumCulled = false;
        lines.renderOrder = 2 + i;
        return lines;
      }),
    );
    this.cutAt([0, 0, 1], 0);
  }

  /** Nine numbers each. */
  setTriangles(triangles: Float32Array): void {
    this.triangles = triangles;
  }

  /** The size of the pane, px. */
  setPane(width: number, height: number): void {
    this.pane.set(width, height);
  }

  cutAt(normal: readonly number[], offset: number): void {
    const ends = new InstancedInterleavedBuffer(sectionLines(this.triangles, normal, offset), 6);
    this.geometry.dispose();
    this.geometry.setAttribute('begin', new InterleavedBufferAttribute(ends, 3, 0));
    this.geometry.setAttribute('end', new InterleavedBufferAttribute(ends, 3, 3));
    this.geometry.instanceCount = ends.count;
  }

  dispose(): void {
    this.geometry.dispose();
    for (const { material } of this.group.children as Mesh[]) (material as RawShaderMaterial).dispose();
  }
}
