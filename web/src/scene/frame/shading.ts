/** The fragment stage that every body shares: soft light from the viewer's shoulder, less in cavities; crisp element edges. */
export const shadingFragment = /* glsl */ `
precision highp float;
precision highp sampler3D;
uniform vec4 clipPlane;
uniform float edgeStrength;
uniform vec3 edgeColour;
uniform float opacity;
/** 1: sheltered places are darker; 0: lit evenly; -1: not lit at all. */
uniform float shelter;
uniform sampler3D open;
uniform mat4 toOpen, viewMatrix;
uniform float cell;
in vec3 vColour;
flat in uint vElement;
in vec3 vView;
in vec3 vWorld;
in vec3 vCorner;
#ifdef SMOOTH
in vec3 vNormal;
#endif
#ifdef FIELD
/** Where it was before the body moved: there its surroundings are known. */
in vec3 vRest;
/** A value, and 1 where there is one. */
in vec2 vValue;
// As precise as in the vertex stage, which WebKit asks for.
uniform highp sampler2D scale;
uniform vec2 range;
uniform float bands;
/** Values this far apart are the same; 0: none are. */
uniform float period;
#endif
#ifdef PICK
layout(location = 0) out uvec4 outPick;
#else
layout(location = 0) out vec4 outColour;
#endif

float edgeLine() {
  // Where a side is no edge its corner's weight is one throughout, and its width nothing.
  vec3 width = max(fwidth(vCorner), 1e-6);
  vec3 near = smoothstep(vec3(0.0), width * 1.1, vCorner);
  // Edges closer together than a few pixels would turn the body black; let them fade out.
  float crowd = max(max(width.x, width.y), width.z);
#ifdef SMOOTH
  // The triangles of a dense surface are all about as large: some with edges and some without would be patches.
  float fade = 1.0 - smoothstep(0.05, 0.16, crowd);
#else
  float fade = 1.0 - smoothstep(0.12, 0.45, crowd);
#endif
  return (1.0 - min(min(near.x, near.y), near.z)) * fade;
}

#ifdef FIELD
vec3 fieldColour() {
  if (vValue.y < 0.999) return vColour;
  float value = vValue.x;
  float line = 0.0;
  if (bands > 0.0) {
    float place = value / bands;
    float width = max(fwidth(place), 1e-6);
    float away = abs(place - round(place));
    line = (1.0 - smoothstep(0.6 * width, 1.4 * width, away)) * (1.0 - smoothstep(0.2, 0.6, width));
    value = bands * (floor(place) + 0.5);
  }
  float place = (value - range.x) / (range.y - range.x);
  float x = period > 0.0 ? fract(place) : clamp(place, 0.0, 1.0);
  return mix(texelFetch(scale, ivec2(int(255.0 * x + 0.5), 0), 0).rgb, vec3(0.05), 0.7 * line);
}
#else
vec3 fieldColour() { return vColour; }
#endif

/** How much of the light from all around comes to a place: 1 where no more than the body's own flat side is in the way. */
float openness(vec3 normal) {
  if (cell == 0.0 || shelter <= 0.0) return 1.0;
#ifdef FIELD
  vec3 at = vRest;
#else
  vec3 at = vWorld;
#endif
  vec3 place = (toOpen * vec4(at + 1.5 * cell * normal, 1.0)).xyz;
  // Beyond the image there is nothing.
  if (place != clamp(place, 0.0, 1.0)) return 1.0;
  return smoothstep(0.0, 0.5, texture(open, place).r);
}

vec3 shaded() {
#ifdef SMOOTH
  vec3 n = normalize(vNormal);
#else
  vec3 n = normalize(cross(dFdx(vView), dFdy(vView)));
#endif
  vec3 toEye = normalize(-vView);
  if (dot(n, toEye) < 0.0) n = -n;
  float key = dot(n, normalize(vec3(0.35, 0.55, 0.75)));
#ifdef SMOOTH
  // Light that reaches around: terraces of voxels stay soft.
  key = mix(max(key, 0.0), 0.5 + 0.5 * key, 0.6);
#else
  key = max(key, 0.0);
#endif
  float fill = max(dot(n, normalize(vec3(-0.6, -0.1, 0.5))), 0.0);
  float sky = 0.5 + 0.5 * n.y;
  vec3 base = fieldColour();
  base *= base;
  if (shelter < 0.0) return sqrt(base);
  float free = openness(n * mat3(viewMatrix));
  vec3 lit = base * ((0.36 + 0.2 * sky) * free + (0.58 * key + 0.2 * fill) * mix(0.3, 1.0, free));
  lit += 0.05 * free * pow(max(dot(n, normalize(toEye + vec3(0.35, 0.55, 0.75))), 0.0), 24.0);
  return sqrt(clamp(lit, 0.0, 1.0));
}

void main() {
  if (dot(clipPlane.xyz, vWorld) > clipPlane.w) discard;
#ifdef PICK
  outPick = uvec4(vElement + 1u, floatBitsToUint(vWorld));
#else
  outColour = vec4(mix(shaded(), edgeColour, edgeLine() * edgeStrength), opacity);
#endif
}`;
