/** Vertex stages that pull a tetrahedral mesh out of textures, so that cuts and choices are uniforms, not new geometry. */
const common = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp isampler2D;
precision highp usampler2D;
uniform mat4 modelViewMatrix, projectionMatrix;
/** Places of the points as they are seen, and before the body moved. */
uniform sampler2D points, rest;
uniform sampler2D centres, values, palette, offsets, scale;
uniform usampler2D tets, mask;
uniform uint need;
uniform vec4 cutPlane;
uniform int paint;
uniform vec2 range;
uniform float period;
uniform float explode;
uniform vec3 plain;
out vec3 vColour;
flat out uint vElement;
out vec3 vView;
out vec3 vWorld;
out vec3 vRest;
out vec3 vCorner;
out vec2 vValue;

ivec2 at(int i) { return ivec2(i & 2047, i >> 11); }
ivec2 ofLabel(int label) { return ivec2(label & 255, label >> 8); }
vec3 point(uint i) { return texelFetch(points, at(int(i)), 0).xyz; }
vec3 restPoint(uint i) { return texelFetch(rest, at(int(i)), 0).xyz; }
bool chosen(int tet) { return (texelFetch(mask, at(tet), 0).r & need) == need; }

/** Of the face that is drawn, where points have values; below 0 there is none. */
float faceValue = -1.0;
/** Of the vertex that is drawn, where values go on from point to point. */
float vertexValue = 0.0;
float atPoint(uint i) { return texelFetch(values, at(int(i)), 0).r; }
/** The same on a circle, by whole turns as near as can be to another value. */
float nearTo(float other, float value) {
  if (period == 0.0 || value < -1e29 || other < -1e29) return value;
  return value - period * round((value - other) / period);
}

vec3 colourOf(int tet, int label) {
  if (paint == 0) return texelFetch(palette, ofLabel(label), 0).rgb;
  if (paint == 3) return plain;
  float value = paint == 4 ? faceValue : paint == 6 ? vertexValue : texelFetch(values, at(tet), 0).r;
  if ((paint == 4 || paint == 5) && value < 0.0) return plain;
  if (value < -1e29) return plain;
  // Coloured pixel by pixel, where all corners have a value.
  if (paint == 6) vValue = vec2(value, 1.0);
  if (paint == 2) return texelFetch(palette, ofLabel(int(value)), 0).rgb;
  float x = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
  return texelFetch(scale, ivec2(int(255.0 * x + 0.5), 0), 0).rgb;
}

void place(int tet, vec3 p, vec3 atRest) {
  vValue = vec2(0.0);
  int label = int(texelFetch(centres, at(tet), 0).w);
  vColour = colourOf(tet, label);
  vElement = uint(tet);
  vWorld = p;
  vRest = atRest;
  vec4 view = modelViewMatrix * vec4(p + explode * texelFetch(offsets, ofLabel(label), 0).xyz, 1.0);
  vView = view.xyz;
  gl_Position = projectionMatrix * view;
}

void leaveOut() {
  vColour = vView = vWorld = vRest = vCorner = vec3(0.0);
  vValue = vec2(0.0);
  vElement = 0u;
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}`;

/** Three vertices a half-face. A face is drawn where exactly one of its tets is kept, or between two exploded labels. */
export const facesVertex = /* glsl */ `${common}
uniform usampler2D faces;
uniform isampler2D neighbours;
uniform ivec2 counts;
uniform bool apart;
const ivec3 opposite[4] = ivec3[4](ivec3(1, 2, 3), ivec3(0, 3, 2), ivec3(0, 1, 3), ivec3(0, 2, 1));

bool kept(int tet) {
  return chosen(tet) && dot(cutPlane.xyz, texelFetch(centres, at(tet), 0).xyz) <= cutPlane.w;
}

void main() {
  int face = gl_VertexID / 3;
  int corner = gl_VertexID % 3;
  int half_ = int(texelFetch(faces, at(face), 0).r);
  int own = half_ >> 2;
  int other = texelFetch(neighbours, at(own), 0)[half_ & 3];
  bool mine = kept(own);
  bool theirs = other >= 0 && kept(other);
  bool shown = face < counts.x ? mine : face < counts.y ? mine && (apart || !theirs) : mine != theirs;
  if (!shown) {
    leaveOut();
    return;
  }
  uvec4 corners = texelFetch(tets, at(own), 0);
  ivec3 turn = opposite[half_ & 3];
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  if (paint == 4 && face < counts.y) {
    for (int k = 0; k < 3; k++) faceValue = max(faceValue, atPoint(corners[turn[k]]));
  }
  if (paint == 6) vertexValue = nearTo(atPoint(corners[turn[0]]), atPoint(corners[turn[corner]]));
  uint seen = corners[turn[corner]];
  place(mine ? own : other, point(seen), restPoint(seen));
}`;

/** Six vertices a tet: the triangle or quad in which a plane cuts it. */
export const sectionVertex = /* glsl */ `${common}
uniform float reach;

void main() {
  int tet = gl_VertexID / 6;
  int vertex = gl_VertexID % 6;
  vec4 centre = texelFetch(centres, at(tet), 0);
  if (!chosen(tet) || abs(dot(cutPlane.xyz, centre.xyz) - cutPlane.w) > reach) {
    leaveOut();
    return;
  }
  uvec4 corners = texelFetch(tets, at(tet), 0);
  vec3 p[4];
  float d[4];
  int above[4];
  int below[4];
  int up = 0;
  int down = 0;
  for (int k = 0; k < 4; k++) {
    p[k] = point(corners[k]);
    d[k] = dot(cutPlane.xyz, p[k]) - cutPlane.w;
    if (d[k] > 0.0) above[up++] = k;
    else below[down++] = k;
  }
  if (up == 0 || down == 0 || (up != 2 && vertex > 2)) {
    leaveOut();
    return;
  }
  int from;
  int to;
  if (up == 2) {
    // The quad above0-below0, above0-below1, above1-below1, above1-below0 in two triangles; their common edge is no edge.
    int place_ = vertex < 3 ? vertex : vertex == 3 ? 0 : vertex - 2;
    from = above[place_ / 2];
    to = below[place_ == 1 || place_ == 2 ? 1 : 0];
    vCorner = vertex < 3 ? vec3(vertex == 0, 1.0, vertex == 2) : vec3(vertex == 3, vertex == 4, 1.0);
  } else {
    from = up == 1 ? above[0] : below[0];
    to = up == 1 ? below[vertex] : above[vertex];
    vCorner = vec3(vertex == 0, vertex == 1, vertex == 2);
  }
  float part = d[from] / (d[from] - d[to]);
  if (paint == 6) {
    float near = atPoint(corners[0]);
    vertexValue = mix(nearTo(near, atPoint(corners[from])), nearTo(near, atPoint(corners[to])), part);
  }
  vec3 seen = mix(p[from], p[to], part);
  place(tet, seen, seen);
}`;
