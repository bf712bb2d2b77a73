/**
 * The colour in which slices show the image at a place, as label `label`: slices are drawn with it, and lines over them
 * are light or dark by it. Its uniforms are those of the image.
 */
export const imageColour = /* glsl */ `
precision highp int;
precision highp sampler3D;
precision highp usampler3D;
uniform usampler3D imageLabels, imagePaint;
uniform sampler3D sizes;
uniform sampler2D imagePalette, meshed, paintPalette, imageScale;
uniform mat4 toLabel, toSize, toPaint;
uniform vec2 sizeRange;
uniform bool bySize;
uniform vec3 backdrop;

ivec2 paletteAt(int label) { return ivec2(label & 255, label >> 8); }

int labelAt(vec3 index) {
  ivec3 size = textureSize(imageLabels, 0);
  ivec3 i = clamp(ivec3(floor(index + 0.5)), ivec3(0), size - 1);
  return int(texelFetch(imageLabels, i, 0).r);
}

/** Sizes are shown in the body that is meshed; around it labels are pale. */
vec4 unpainted(vec3 world, int label) {
  vec4 own = texelFetch(imagePalette, paletteAt(label), 0);
  if (!bySize) return own;
  vec3 place = ((toSize * vec4(world, 1.0)).xyz + 0.5) / vec3(textureSize(sizes, 0));
  float value = texture(sizes, place).r;
  bool inBody = label > 0 && texelFetch(meshed, paletteAt(label), 0).a > 0.5;
  if (value <= 0.0 || !inBody) return vec4(own.rgb, 0.28 * own.a);
  float x = clamp((value - sizeRange.x) / (sizeRange.y - sizeRange.x), 0.0, 1.0);
  return vec4(texelFetch(imageScale, ivec2(int(255.0 * x + 0.5), 0), 0).rgb, 1.0);
}

int paintAt(vec3 index) {
  ivec3 i = ivec3(floor(index + 0.5));
  bool inside = all(greaterThanEqual(i, ivec3(0))) && all(lessThan(i, textureSize(imagePaint, 0)));
  return inside ? int(texelFetch(imagePaint, i, 0).r) : 0;
}

vec4 imageColour(vec3 world, int label) {
  vec4 under = unpainted(world, label);
  int painted = paintAt((toPaint * vec4(world, 1.0)).xyz);
  if (painted == 0) return under;
  vec4 own = texelFetch(paintPalette, paletteAt(painted), 0);
  return vec4(mix(under.rgb, own.rgb, 0.65), max(under.a, 0.85));
}

/** Of a line that is to be seen on the image. */
vec3 inkOn(vec4 under) {
  vec3 seen = mix(backdrop, under.rgb, under.a);
  return dot(seen, vec3(0.299, 0.587, 0.114)) < 0.25 ? vec3(0.96) : vec3(0.04, 0.06, 0.09);
}`;
