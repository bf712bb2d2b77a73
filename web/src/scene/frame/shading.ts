/** The fragment stage that every body shares: soft light from the viewer's shoulder, crisp element edges. */
export const shadingFragment = /* glsl */ `
precision highp float;
uniform vec4 clipPlane;
uniform float edgeStrength;
uniform vec3 edgeColour;
uniform float opacity;
in vec3 vColour;
flat in uint vElement;
in vec3 vView;
in vec3 vWorld;
in vec3 vCorner;
#ifdef SMOOTH
in vec3 vNormal;
#endif
#ifdef FIELD
/** A value, and 1 where there is one. */
in vec2 vValue;
uniform sampler2D scale;
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
  return (1.0 - min(min(near.x, near.y), near.z)) * (1.0 - smoothstep(0.12, 0.45, crowd));
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

vec3 shaded() {
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
  vec3 base = fieldColour();
  base *= base;
  vec3 lit = base * (0.3 + 0.16 * sky + 0.66 * key + 0.22 * fill);
  lit += 0.05 * pow(max(dot(n, normalize(toEye + vec3(0.35, 0.55, 0.75))), 0.0), 24.0);
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
