/** DICOM segmentation objects as label volumes. Loaded once such a file is opened; reads without a network of others. */
import { readOverlappingSegmentation, setPipelinesBaseUrl } from '@itk-wasm/dicom';
import { writeNrrd, type Segment } from '../geometry/nrrd';

interface SegmentAttributes {
  labelID: number;
  SegmentLabel?: string;
  recommendedDisplayRGBValue?: number[];
}

/** The image of what was read: groups of segments that do not overlap are the components of a voxel. */
interface SegmentationImage {
  imageType: { components: number };
  size: number[];
  spacing: number[];
  origin: number[];
  /** Row-major; columns are the axes. */
  direction: ArrayLike<number>;
  data: ArrayLike<number> | null;
}

/** Where the build has put the package's files. */
const filesUrl = () => new URL(import.meta.env.VITE_DICOM, document.baseURI).href;

/** The image in patient space RAS; DICOM's is LPS. Overlaps are left to the engine: the later segment wins there. */
export function toNrrd(image: SegmentationImage, segments: readonly Segment[]): Uint8Array<ArrayBuffer> {
  const { size, spacing, origin, direction, data } = image;
  const { components } = image.imageType;
  if (!data || size.length !== 3) throw new Error('found no image of three axes');
  const signs = [-1, -1, 1];
  const indexToMm = signs.flatMap((sign, row) => [
    ...spacing.map((step, axis) => sign * direction[3 * row + axis] * step),
    sign * origin[row],
  ]);
  return writeNrrd(
    { size, indexToMm: [...indexToMm, 0, 0, 0, 1] },
    Uint16Array.from(data),
    segments,
    components,
  );
}

/** The labels of a DICOM segmentation object, with names and colours, as the NRRD file that the engine reads. */
export async function readDicomSegmentation(
  name: string,
  bytes: Uint8Array,
): Promise<Uint8Array<ArrayBuffer>> {
  setPipelinesBaseUrl(filesUrl());
  const worker = new Worker(`${filesUrl()}/itk-wasm-pipeline.min.worker.js`, { type: 'module' });
  try {
    const { segImage, metaInfo } = await readOverlappingSegmentation(
      { path: 'segmentation.dcm', data: bytes },
      { webWorker: worker, mergeSegments: true },
    );
    const groups = (metaInfo as unknown as { segmentAttributes?: SegmentAttributes[][] }).segmentAttributes;
    const segments = (groups ?? []).flatMap((group, layer) =>
      group.map((one) => ({
        label: one.labelID,
        name: one.SegmentLabel ?? '',
        colour: one.recommendedDisplayRGBValue?.map((part) => part / 255),
        layer,
      })),
    );
    // In the file's order, which the groups need not keep.
    segments.sort((a, b) => a.label - b.label);
    return toNrrd(segImage as SegmentationImage, segments);
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw new Error(`${name} cannot be read as a DICOM segmentation object: ${reason.trim().slice(0, 300)}`, {
      cause: error,
    });
  } finally {
    worker.terminate();
  }
}
