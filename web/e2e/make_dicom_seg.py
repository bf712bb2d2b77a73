"""Writes a small DICOM segmentation object and, by numpy alone, the same labels as NRRD: make_dicom_seg.py FOLDER."""
import pathlib
import sys

import numpy as np
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.uid import ExplicitVRLittleEndian, generate_uid

folder = pathlib.Path(sys.argv[1])
columns, rows, slices = 24, 20, 12
spacing = (1.5, 2.0, 3.0)  # along columns' index, rows' index, slices
# Oblique, as short-axis images of the heart are.
along_row, along_column = np.array([2, 1, 2]) / 3, np.array([-2, 2, 1]) / 3
normal = np.cross(along_row, along_column)
origin = np.array([-10.0, -20.0, 30.0])  # LPS

i, j, k = np.meshgrid(range(columns), range(rows), range(slices), indexing="ij")
mm = np.stack([(i - 11.5) * spacing[0], (j - 9.5) * spacing[1], (k - 5.5) * spacing[2]])
radius = np.sqrt((mm**2).sum(axis=0))
labels = np.zeros((columns, rows, slices), np.uint8)
labels[radius < 14] = 1
labels[radius < 7] = 2
segments = [("Left ventricle wall", (255, 0, 0)), ("Left ventricle blood", (0, 0, 255))]


def code(value, scheme, meaning):
    item = Dataset()
    item.CodeValue, item.CodingSchemeDesignator, item.CodeMeaning = value, scheme, meaning
    return item


def cielab(rgb):
    linear = np.array(rgb) / 255
    linear = np.where(linear > 0.04045, ((linear + 0.055) / 1.055) ** 2.4, linear / 12.92)
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ linear
    f = xyz / np.array([0.9505, 1, 1.089])
    f = np.where(f > 0.008856, np.cbrt(f), 7.787 * f + 16 / 116)
    lab = 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])
    return [int(lab[0] / 100 * 65535), int((lab[1] + 128) / 255 * 65535), int((lab[2] + 128) / 255 * 65535)]


seg = Dataset()
seg.SOPClassUID = "1.2.840.10008.5.1.4.1.1.66.4"
seg.SOPInstanceUID, seg.StudyInstanceUID, seg.SeriesInstanceUID = generate_uid(), generate_uid(), generate_uid()
seg.FrameOfReferenceUID, seg.PositionReferenceIndicator = generate_uid(), ""
seg.PatientName, seg.PatientID, seg.PatientBirthDate, seg.PatientSex = "Made^Up", "0", "", "O"
seg.StudyDate, seg.StudyTime, seg.AccessionNumber, seg.ReferringPhysicianName, seg.StudyID = "20200101", "120000", "", "", "1"
seg.Modality, seg.SeriesNumber, seg.InstanceNumber = "SEG", 1, 1
seg.ContentDate, seg.ContentTime = "20200101", "120000"
seg.ContentLabel, seg.ContentDescription, seg.ContentCreatorName = "SEGMENTATION", "Two balls", "Made^Up"
seg.Manufacturer, seg.ManufacturerModelName, seg.DeviceSerialNumber, seg.SoftwareVersions = "test", "test", "1", "1"
seg.ImageType = ["DERIVED", "PRIMARY"]
seg.Rows, seg.Columns, seg.NumberOfFrames = rows, columns, slices * len(segments)
seg.SamplesPerPixel, seg.PhotometricInterpretation, seg.PixelRepresentation = 1, "MONOCHROME2", 0
seg.BitsAllocated, seg.BitsStored, seg.HighBit = 1, 1, 0
seg.LossyImageCompression, seg.SegmentationType = "00", "BINARY"

organization = Dataset()
organization.DimensionOrganizationUID = generate_uid()
seg.DimensionOrganizationSequence = [organization]
indices = []
for pointer, group in [(0x0062000B, 0x0062000A), (0x00200032, 0x00209113)]:
    index = Dataset()
    index.DimensionOrganizationUID = organization.DimensionOrganizationUID
    index.DimensionIndexPointer, index.FunctionalGroupPointer = pointer, group
    indices.append(index)
seg.DimensionIndexSequence = indices

seg.SegmentSequence = []
for number, (name, colour) in enumerate(segments, 1):
    segment = Dataset()
    segment.SegmentNumber, segment.SegmentLabel, segment.SegmentAlgorithmType = number, name, "MANUAL"
    segment.SegmentedPropertyCategoryCodeSequence = [code("123037004", "SCT", "Anatomical Structure")]
    segment.SegmentedPropertyTypeCodeSequence = [code("87878005", "SCT", "Left ventricle")]
    segment.RecommendedDisplayCIELabValue = cielab(colour)
    seg.SegmentSequence.append(segment)

shared, orientation, measures = Dataset(), Dataset(), Dataset()
orientation.ImageOrientationPatient = [f"{x:.12f}" for x in [*along_row, *along_column]]
measures.PixelSpacing, measures.SliceThickness = [spacing[1], spacing[0]], spacing[2]
measures.SpacingBetweenSlices = spacing[2]
shared.PlaneOrientationSequence, shared.PixelMeasuresSequence = [orientation], [measures]
seg.SharedFunctionalGroupsSequence = [shared]

seg.PerFrameFunctionalGroupsSequence = []
bits = []
for number in range(1, len(segments) + 1):
    for at in range(slices):
        frame, content, position, identity = Dataset(), Dataset(), Dataset(), Dataset()
        content.DimensionIndexValues = [number, at + 1]
        position.ImagePositionPatient = [f"{x:.9f}" for x in origin + at * spacing[2] * normal]
        identity.ReferencedSegmentNumber = number
        frame.FrameContentSequence, frame.PlanePositionSequence = [content], [position]
        frame.SegmentIdentificationSequence = [identity]
        seg.PerFrameFunctionalGroupsSequence.append(frame)
        bits.append((labels[:, :, at] == number).T.ravel())
packed = np.packbits(np.concatenate(bits), bitorder="little").tobytes()
seg.add_new(0x7FE00010, "OB", packed + b"\0" * (len(packed) % 2))

meta = FileMetaDataset()
meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = seg.SOPClassUID, seg.SOPInstanceUID
meta.TransferSyntaxUID = ExplicitVRLittleEndian
seg.file_meta, seg.is_little_endian, seg.is_implicit_VR = meta, True, False
seg.save_as(folder / "heart.dcm", write_like_original=False)

axes = [way * step for way, step in zip((along_row, along_column, normal), spacing)]
vector = lambda v: "(" + ",".join(repr(float(x)) for x in v) + ")"
header = (
    "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
    f"sizes: {columns} {rows} {slices}\nspace directions: {' '.join(map(vector, axes))}\n"
    f"space origin: {vector(origin)}\nencoding: raw\n\n"
)
(folder / "heart.nrrd").write_bytes(header.encode() + labels.ravel(order="F").tobytes())
