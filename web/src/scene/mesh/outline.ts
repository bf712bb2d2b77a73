import { effect } from '@preact/signals';
import { BufferGeometry, Color, GLSL3, Mesh, RawShaderMaterial, Vector2, Vector3 } from 'three';
import type { StageName } from '../../engine/contract';
import { movedMesh } from '../../store/run/beat/motion';
import { shownResult } from '../../store/run/results';
import { explode, picked, stageShown } from '../../store/view';
import type { Viewer } from '../frame/viewer';
import { markColour } from './markers';
import { isOnTets, tetCorners } from './tets_view';

/** Pixels across a line, its light border included. */
const lineWidth = 6;

/** Twice six edges, each a strip of two triangles as wide on the screen everywhere: the borders first, then the lines. */
const vertexShader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec3 corners[4];
uniform vec2 pane;
uniform float width;
uniform int edgeCount;
flat out int line;
// The first three are those of a triangle.
const ivec2 edges[6] = ivec2[6](ivec2(0, 1), ivec2(0, 2), ivec2(1, 2), ivec2(0, 3), ivec2(1, 3), ivec2(2, 3));
vec4 seen(int corner) { return projectionMatrix * modelViewMatrix * vec4(corners[corner], 1.0); }
void main() {
  int strip = gl_VertexID / 6;
  int k = gl_VertexID % 6;
  line = strip / edgeCount;
  ivec2 edge = edges[strip % edgeCount];
  vec4 from = seen(edge.x);
  vec4 to = seen(edge.y);
  vec2 way = (to.xy / to.w - from.xy / from.w) * pane;
  vec2 along = length(way) > 0.0 ? normalize(way) : vec2(1.0, 0.0);
  bool atEnd = k == 1 || k == 2 || k == 4;
  float side = k == 2 || k > 3 ? 1.0 : -1.0;
  vec4 place = atEnd ? to : from;
  float reach = line == 0 ? width : 0.55 * width;
  vec2 shift = 0.5 * reach * (vec2(-along.y, along.x) * side + (atEnd ? along : -along));
  gl_Position = min(from.w, to.w) > 0.0
    ? vec4(place.xy + 2.0 * shift / pane * place.w, place.zw)
    : vec4(0.0, 0.0, 2.0, 1.0);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform vec3 colour;
flat in int line;
out vec4 outColour;
void main() {
  outColour = line == 0 ? vec4(1.0) : vec4(colour, 1.0);
}`;

/** The corners of an element where the view shows it. */
function cornersOf(stage: StageName, element: number): Vector3[] {
  if (isOnTets(stage)) {
    const mesh = movedMesh.value;
    return mesh && 4 * element < mesh.tets.length ? tetCorners(mesh, element, explode.value) : [];
  }
  const surface = stage === 'surface' || stage === 'smooth' || stage === 'remesh' ? shownResult(stage) : null;
  if (!surface || 3 * element >= surface.triangles.length) return [];
  return [0, 1, 2].map((k) =>
    new Vector3().fromArray(surface.points, 3 * surface.triangles[3 * element + k]),
  );
}

/** The edges of the element whose numbers are shown, through everything before it. */
export function addOutline(viewer: Viewer): () => void {
  const geometry = new BufferGeometry();
  const corners = [0, 1, 2, 3].map(() => new Vector3());
  const pane = new Vector2();
  const material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    depthTest: false,
    depthWrite: false,
    transparent: true,
    uniforms: {
      corners: { value: corners },
      pane: { value: pane },
      width: { value: lineWidth },
      edgeCount: { value: 6 },
      colour: { value: new Color().setHex(markColour, '') },
    },
  });
  const lines = new Mesh(geometry, material);
  lines.frustumCulled = false;
  lines.renderOrder = 6;
  lines.onBeforeRender = () => void pane.set(viewer.element.clientWidth, viewer.element.clientHeight);
  viewer.add(lines);
  const stop = effect(() => {
    const found = picked.value;
    const same =
      found && (found.stage === stageShown.value || isOnTets(found.stage) === isOnTets(stageShown.value));
    const places = same ? cornersOf(found.stage, found.element) : [];
    places.forEach((place, k) => corners[k].copy(place));
    const edges = places.length === 4 ? 6 : places.length;
    material.uniforms.edgeCount.value = edges;
    geometry.setDrawRange(0, 2 * 6 * edges);
    lines.visible = edges > 0;
    viewer.invalidate();
  });
  return () => {
    stop();
    viewer.scene.remove(lines);
    geometry.dispose();
    material.dispose();
    viewer.invalidate();
  };
}
