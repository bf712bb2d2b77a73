import { expect, it } from 'vitest';
import { readOwnNrrd } from '../geometry/nrrd';
import { toNrrd } from './read_segmentation';

const image = {
  imageType: { components: 2 },
  size: [2, 1, 1],
  spacing: [2, 3, 4],
  origin: [10, 20, 30],
  direction: [0, -1, 0, 1, 0, 0, 0, 0, 1],
  data: [0, 3, 1, 2],
};

it('keeps each group of segments as a layer, and turns the axes from LPS to RAS', () => {
  const text = new TextDecoder('latin1').decode(
    toNrrd(image, [
      { label: 1, name: 'Pool', layer: 0 },
      { label: 3, name: 'Aorta\nwall', colour: [1, 0, 0.5], layer: 1 },
    ]),
  );
  expect(text).toContain('dimension: 4\n');
  expect(text).toContain('sizes: 2 2 1 1\n');
  expect(text).toContain('space directions: none (0,-2,0) (3,0,0) (0,0,4)');
  expect(text).toContain('kinds: list domain domain domain\n');
  expect(text).toContain('space origin: (-10,-20,30)');
  expect(text).toContain('Segment0_Name:=Pool\nSegment0_LabelValue:=1\nSegment0_Layer:=0');
  expect(text).toContain(
    'Segment1_Name:=Aorta wall\nSegment1_LabelValue:=3\nSegment1_Layer:=1\nSegment1_Color:=1 0 0.5',
  );
  expect(text.endsWith('\x00\x00\x03\x00\x01\x00\x02\x00')).toBe(true);
});

it('writes one group as a plain volume', () => {
  const plain = toNrrd({ ...image, imageType: { components: 1 }, data: [0, 3] }, []);
  const text = new TextDecoder('latin1').decode(plain);
  expect(text).toContain('dimension: 3\n');
  expect(text.endsWith('\x00\x00\x03\x00')).toBe(true);
  expect(readOwnNrrd(plain)).toBeNull();
});

it('says what is missing of an image', () => {
  expect(() => toNrrd({ ...image, data: null }, [])).toThrow('no image');
});
