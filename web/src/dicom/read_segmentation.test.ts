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

it('keeps the later of segments that overlap, and turns the axes from LPS to RAS', () => {
  const text = new TextDecoder('latin1').decode(
    toNrrd(image, [{ label: 3, name: 'Aorta\nwall', colour: [1, 0, 0.5] }]),
  );
  expect(text).toContain('space directions: (0,-2,0) (3,0,0) (0,0,4)');
  expect(text).toContain('space origin: (-10,-20,30)');
  expect(text).toContain('Segment0_Name:=Aorta wall\nSegment0_LabelValue:=3\nSegment0_Color:=1 0 0.5');
  expect(text.endsWith('\x03\x00\x02\x00')).toBe(true);
  expect(readOwnNrrd(toNrrd(image, []))).toBeNull();
});

it('says what is missing of an image', () => {
  expect(() => toNrrd({ ...image, data: null }, [])).toThrow('no image');
});
