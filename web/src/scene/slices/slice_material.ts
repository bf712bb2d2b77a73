import {
  Color,
  Data3DTexture,
  DoubleSide,
  FloatType,
  GLSL3,
  LinearFilter,
  Matrix4,
  RawShaderMaterial,
  RedFormat,
  RedIntegerFormat,
  UnsignedByteType,
  UnsignedShortType,
  Vector2,
  Vector3,
  type Texture,
} from 'three';
import { paintColour } from '../../geometry/colours';
import type { Grid } from '../../geometry/grid_values';
import type { Field } from '../../store/run/sizing_fields';
import type { Labels } from '../../engine/contract';
import type { Legend } from '../../store/view';
import { imageColour } from '../frame/image_colour';
import { paletteTexture, scaleTexture } from '../frame/textures';

const vertexShader = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 position;
out vec3 vWorld;
void main() {
  vWorld = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
${imageColour}
in vec3 vWorld;
layout(location = 0) out vec4 outColour;

void main() {
  vec3 index = (toLabel * vec4(vWorld, 1.0)).xyz;
  int label = labelAt(index);
  outColour = imageColour(vWorld, label);
  if (!bySize || label == 0) return;
  // The labels stay visible as outlines in their own colours.
  vec3 right = dFdx(index);
  vec3 up = dFdy(index);
  bool border = labelAt(index + right) != label || labelAt(index - right) != label ||
    labelAt(index + up) != label || labelAt(index - up) != label;
  if (border) outColour = vec4(texelFetch(imagePalette, paletteAt(label), 0).rgb, 1.0);
}`;

function volumeTexture(
  data: Float32Array | Uint8Array | Uint16Array,
  size: readonly number[],
): Data3DTexture {
  const texture = new Data3DTexture(data as never, size[0], size[1], size[2]);
  texture.format = data instanceof Float32Array ? RedFormat : RedIntegerFormat;
  texture.type =
    data instanceof Float32Array
      ? FloatType
      : data instanceof Uint8Array
        ? UnsignedByteType
        : UnsignedShortType;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

function inverse(indexToMm: readonly number[]): Matrix4 {
  return new Matrix4().set(...(indexToMm as Parameters<Matrix4['set']>)).invert();
}

/** The image as 3-D textures, looked up by whatever slices show it. */
export class SliceImage {
  readonly material: RawShaderMaterial;
  grid: Grid = { size: [1, 1, 1], indexToMm: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] };
  private readonly smooth: boolean;
  private shown: Labels | null = null;

  /** `smooth`: whether the graphics card interpolates floats. */
  constructor(smooth: boolean) {
    this.smooth = smooth;
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      side: DoubleSide,
      transparent: true,
      depthWrite: true,
      uniforms: {
        imageLabels: { value: volumeTexture(new Uint8Array(1), [1, 1, 1]) },
        sizes: { value: volumeTexture(new Float32Array(1), [1, 1, 1]) },
        imagePalette: { value: paletteTexture(0, () => '#000000', new Set()) },
        meshed: { value: paletteTexture(0, () => '#000000', new Set()) },
        imageScale: { value: scaleTexture('viridis') },
        toLabel: { value: new Matrix4() },
        toSize: { value: new Matrix4() },
        toPaint: { value: new Matrix4() },
        imagePaint: { value: volumeTexture(new Uint8Array(1), [1, 1, 1]) },
        paintPalette: { value: paletteTexture(255, paintColour, new Set()) },
        sizeRange: { value: new Vector2(0, 1) },
        bySize: { value: false },
        backdrop: { value: new Color(1, 1, 1) },
      },
    });
  }

  setLabels(labels: Labels, grid: Grid): void {
    if (this.shown === labels) return;
    this.shown = labels;
    this.replace('imageLabels', volumeTexture(labels, grid.size));
    this.material.uniforms.toLabel.value.copy(inverse(grid.indexToMm));
  }

  setColours(largest: number, colour: (label: number) => string, hidden: ReadonlySet<number>): void {
    this.replace('imagePalette', paletteTexture(largest, colour, hidden));
  }

  /** What lies outside of these labels is not meshed. */
  setMeshed(known: readonly number[], meshed: ReadonlySet<number>): void {
    const left = new Set(known.filter((label) => !meshed.has(label)));
    this.replace(
      'meshed',
      paletteTexture(Math.max(0, ...known), () => '#000000', left),
    );
  }

  /** How light it is behind the image. */
  setBackdrop(lightness: number): void {
    this.material.uniforms.backdrop.value.setScalar(lightness);
  }

  /** A field in colour. Where it is 0 there is none: with `gaps` of that kind nothing may be interpolated. */
  setField({ values, grid }: Field, { map, lo, hi }: Legend, gaps: boolean): void {
    const texture = volumeTexture(values, grid.size);
    if (this.smooth && !gaps) texture.magFilter = texture.minFilter = LinearFilter;
    this.replace('imageScale', scaleTexture(map));
    this.replace('sizes', texture);
    this.material.uniforms.toSize.value.copy(inverse(grid.indexToMm));
    this.material.uniforms.sizeRange.value.set(lo, hi);
  }

  /** What is painted over the image; null: nothing. The same labels again have changed in place. */
  setPaint(labels: Uint8Array | null, grid: Grid): void {
    const texture = this.material.uniforms.imagePaint.value as Data3DTexture;
    if (labels && texture.image.data === labels) {
      texture.needsUpdate = true;
      return;
    }
    this.replace(
      'imagePaint',
      labels ? volumeTexture(labels, grid.size) : volumeTexture(new Uint8Array(1), [1, 1, 1]),
    );
    this.material.uniforms.toPaint.value.copy(inverse(grid.indexToMm));
  }

  showSizes(on: boolean): void {
    this.material.uniforms.bySize.value = on;
  }

  /** Corners of the slice across `axis` at `place` of the way from the first voxel to the last, as two triangles. */
  corners(axis: number, place: number): Vector3[] {
    const { size, indexToMm } = this.grid;
    const matrix = new Matrix4().set(...(indexToMm as Parameters<Matrix4['set']>));
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    return [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 0],
      [1, 1],
      [0, 1],
    ].map(([a, b]) => {
      const index = [0, 0, 0];
      index[axis] = Math.round(place * (size[axis] - 1));
      index[u] = a * size[u] - 0.5;
      index[v] = b * size[v] - 0.5;
      return new Vector3(...(index as [number, number, number])).applyMatrix4(matrix);
    });
  }

  dispose(): void {
    for (const { value } of Object.values(this.material.uniforms)) (value as Partial<Texture>).dispose?.();
    this.material.dispose();
  }

  private replace(
    name: 'imageLabels' | 'sizes' | 'imageScale' | 'imagePaint' | 'imagePalette' | 'meshed',
    texture: Texture,
  ): void {
    (this.material.uniforms[name].value as Texture).dispose();
    this.material.uniforms[name].value = texture;
  }
}
