"""Compares how voxtet reads volumes (dump_volume) with nibabel, VTK and a small parser of NRRD and MetaImage.

Sample run: check_volumes.py build/native/tests/unit/io/dump_volume

1. Every shared volume: the same size, voxels and affine (1e-4 mm); written again as NIfTI, nibabel reads the same.
2. Volumes written by nibabel (types, byte orders, versions, sform and qform, scaling) and by VTK.
3. Shared volumes with a damaged header byte: where voxtet reads one, the other reader must see the same.
Exit code 77: something that this needs is absent.
"""
import gzip
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import zlib

try:
    import nibabel
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("VOXTET_DATA", ROOT / ".." / "shared" / "data"))
TOLERANCE_MM = 1e-4
LPS_TO_RAS = np.diag([-1.0, -1.0, 1.0, 1.0])
DAMAGES = 200
NUMPY_TYPES = {"unsigned char": "u1", "short": "i2", "unsigned short": "u2", "MET_UCHAR": "u1"}
NIFTI_UNIT_MM = {0: 1.0, 1: 1000.0, 2: 1.0, 3: 0.001}

nibabel.imageglobals.logger.setLevel("CRITICAL")
np.seterr(all="ignore")


class Unreadable(Exception):
    """The other reader cannot say what the file means."""


def expect(condition, sentence):
    if not condition:
        raise AssertionError(sentence)


def dump(tool, paths, folder, again=False):
    """Runs dump_volume: for each path its JSON, with `voxels` in it where there was no error."""
    command = [tool, str(folder)] + (["nifti"] if again else [])
    done = subprocess.run(command, input="\n".join(map(str, paths)) + "\n", capture_output=True,
                          encoding="latin-1", check=False)
    expect(done.returncode == 0, f"dump_volume ended with {done.returncode}: {done.stderr[-2000:]}")
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    expect(len(answers) == len(paths), f"{len(answers)} answers for {len(paths)} files")
    for n, answer in enumerate(answers):
        if "error" not in answer:
            answer["voxels"] = np.fromfile(folder / f"{n}.u16", "<u2").reshape(answer["size"], order="F")
            answer["affine"] = np.array(answer["affine"]).reshape(4, 4)
    return answers


def read_nifti(path):
    try:
        image = nibabel.load(path)
        voxels = np.asarray(image.dataobj)
        scale = NIFTI_UNIT_MM[int(image.header["xyzt_units"]) & 7]
    except Exception as problem:
        raise Unreadable(str(problem)) from problem
    return voxels.reshape(voxels.shape[:3]), np.diag([scale, scale, scale, 1]) @ image.affine


def read_nrrd(path):
    head, data = path.read_bytes().split(b"\n\n", 1)
    try:
        lines = [line for line in head.decode("latin-1").split("\n")[1:] if not line.startswith("#")]
        fields = {k.strip().lower().replace(" ", ""): v.strip()
                  for k, v in (line.split(": ", 1) for line in lines if ": " in line and ":=" not in line)}
        size = [int(n) for n in fields["sizes"].split()]
        kind = np.dtype(NUMPY_TYPES[fields["type"]]).newbyteorder("<" if fields.get("endian") != "big" else ">")
        data = gzip.decompress(data) if fields["encoding"] == "gzip" else data
        affine = np.eye(4)
        if "spacedirections" in fields:
            vectors = fields["spacedirections"].strip("()").split(") (")
            affine[:3, :3] = np.array([[float(x) for x in v.split(",")] for v in vectors]).T
        if "spaceorigin" in fields:
            affine[:3, 3] = [float(x) for x in fields["spaceorigin"].strip("()").split(",")]
        turn = {"left-posterior-superior": LPS_TO_RAS, None: LPS_TO_RAS}[fields.get("space")]
        return np.frombuffer(data, kind).reshape(size, order="F"), turn @ affine
    except Exception as problem:
        raise Unreadable(str(problem)) from problem


def read_metaimage(path):
    mark = b"ElementDataFile = LOCAL\n"
    head, data = path.read_bytes().split(mark, 1)
    try:
        fields = dict((part.strip() for part in line.split("=", 1))
                      for line in head.decode("latin-1").split("\n") if "=" in line)
        size = [int(n) for n in fields["DimSize"].split()]
        if fields.get("CompressedData") == "True":
            data = zlib.decompress(data)
        numbers = {key: np.array([float(x) for x in fields[key].split()])
                   for key in ("TransformMatrix", "Offset", "ElementSpacing")}
        affine = np.eye(4)
        affine[:3, :3] = numbers["TransformMatrix"].reshape(3, 3).T * numbers["ElementSpacing"]
        affine[:3, 3] = numbers["Offset"]
        return np.frombuffer(data, NUMPY_TYPES[fields["ElementType"]]).reshape(size, order="F"), LPS_TO_RAS @ affine
    except Exception as problem:
        raise Unreadable(str(problem)) from problem


def read_independently(path):
    if path.suffix == ".mha":
        return read_metaimage(path)
    return read_nrrd(path) if path.suffix == ".nrrd" else read_nifti(path)


def same(answer, voxels, affine, name):
    expect("error" not in answer, f"{name}: {answer.get('error')}")
    expect(answer["voxels"].shape == voxels.shape, f"{name}: size {answer['size']}, expected {voxels.shape}")
    # Scaled voxels are rounded to whole numbers that are as near as this (collect_labels.h).
    slack = 0.05 if voxels.dtype.kind == "f" else 0
    expect(np.all(np.abs(answer["voxels"].astype("f8") - voxels) <= slack), f"{name}: the voxels differ")
    off = np.abs(answer["affine"] - affine)
    expect(np.all(off <= TOLERANCE_MM + 1e-6 * np.abs(affine)), f"{name}: the affine is off by {off.max()} mm")


def vtk_voxels(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions(), order="F")


def check_shared(tool, folder):
    paths = sorted(p for p in DATA.iterdir() if p.name.endswith((".nii.gz", ".mha", ".nrrd")))
    answers = dump(tool, paths, folder, again=True)
    worst = 0.0
    for n, (path, answer) in enumerate(zip(paths, answers)):
        voxels, affine = read_independently(path)
        same(answer, voxels, affine, path.name)
        worst = max(worst, np.abs(answer["affine"] - affine).max())
        # VTK's NRRD reader fails in builds with MPI.
        if path.suffix == ".mha":
            expect(np.array_equal(vtk_voxels(vtk.vtkMetaImageReader(), path), voxels), f"{path.name}: VTK reads other voxels")
        again = nibabel.load(folder / f"{n}.nii.gz")
        same(answer, np.asarray(again.dataobj), again.affine, f"{path.name} written again")
        same(answer, np.asarray(again.dataobj), again.get_qform(), f"{path.name} written again, qform")
    print(f"{len(paths)} shared volumes agree; the affines to {worst:.1e} mm")


def set_scaling(path, second, order, slope, inter):
    """nibabel chooses slopes by itself, and lossy ones: this puts them into its file."""
    whole = bytearray(path.read_bytes())
    numbers = np.array([slope, inter], order + ("f8" if second else "f4")).tobytes()
    at = 176 if second else 112
    whole[at:at + len(numbers)] = numbers
    path.write_bytes(whole)


def check_written_by_others(tool, folder):
    generator = np.random.default_rng(7)
    labels = generator.integers(0, 100, (5, 4, 3))
    turn = np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3
    cases = []
    for image_class in (nibabel.Nifti1Image, nibabel.Nifti2Image):
        for kind in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"):
            for order in "<>":
                for form in ("sform", "qform", "mirrored qform", "none", "scaled"):
                    affine = np.eye(4)
                    affine[:3, :3] = turn @ np.diag([0.7, 1.4, 8 if form != "mirrored qform" else -8])
                    affine[:3, 3] = [-44.1, 88.3, 116.8]
                    header = image_class.header_class(endianness=order)
                    header.set_data_dtype(np.dtype(kind))
                    image = image_class(labels.astype(kind), affine, header)
                    image.set_sform(affine, 2 if form in ("sform", "scaled") else 0)
                    image.set_qform(affine, 1 if "qform" in form else 0)
                    path = folder / f"{image_class.__name__}-{kind}-{'le' if order == '<' else 'be'}-{form}.nii"
                    image.to_filename(path)
                    if form == "scaled":
                        set_scaling(path, image_class is nibabel.Nifti2Image, order, slope=2, inter=3)
                    cases.append(path)
    for path, answer in zip(cases, dump(tool, cases, folder)):
        same(answer, *read_nifti(path), path.name)

    image = vtk.vtkImageData()
    image.SetDimensions(labels.shape)
    image.SetSpacing(0.7, 1.4, 8)
    image.SetOrigin(-44.1, 88.3, 116.8)
    image.GetPointData().SetScalars(numpy_to_vtk(labels.astype("u2").ravel(order="F"), deep=True))
    paths = []
    for name in ("vtk.mha", "vtk.mhd"):
        writer = vtk.vtkMetaImageWriter()
        writer.SetFileName(str(folder / name))
        writer.SetCompression(name == "vtk.mha")
        writer.SetInputData(image)
        writer.Write()
        paths.append(folder / name)
    affine = np.diag([0.7, 1.4, 8, 1])
    affine[:3, 3] = [-44.1, 88.3, 116.8]
    for path, answer in zip(paths, dump(tool, paths, folder)):
        same(answer, labels, LPS_TO_RAS @ affine, path.name)
    print(f"{len(cases)} volumes written by nibabel and {len(paths)} by VTK agree")


def damaged_headers(path, folder, seed):
    """Copies of a file with one byte of its header changed, inflated first where the header is compressed."""
    nifti = path.name.endswith(".nii.gz")
    whole = gzip.open(path).read() if nifti else path.read_bytes()
    mark = b"ElementDataFile = LOCAL\n" if path.suffix == ".mha" else b"\n\n"
    header = 348 if nifti else whole.index(mark)
    generator = random.Random(seed)
    for n in range(DAMAGES):
        at = generator.randrange(header)
        damaged = bytearray(whole)
        damaged[at] ^= generator.randrange(1, 256)
        copy = folder / f"damaged-{n}{'.nii' if nifti else path.suffix}"
        copy.write_bytes(damaged)
        yield at, copy


def check_damaged(tool, folder):
    # The larger ones hold the same kinds of header.
    names = ["biv_ed_oblique_sax.nii.gz", "biv_ed_oblique_sax.mha", "biv_ed_oblique_sax.seg.nrrd",
             "biv_es_oblique_sax.nii.gz", "biv_mean_2mm_float32.nii.gz", "prostate_phantom.nrrd", "mickey.nrrd"]
    for seed, name in enumerate(names):
        places, copies = zip(*damaged_headers(DATA / name, folder, seed))
        read = refused = unknown = 0
        for at, copy, answer in zip(places, copies, dump(tool, copies, folder)):
            if "error" in answer:
                refused += 1
                continue
            try:
                voxels, affine = read_independently(copy)
            except Unreadable as problem:
                unknown += 1
                print(f"  {name}, byte {at}: read by voxtet only ({problem})")
                continue
            same(answer, voxels, affine, f"{name} with byte {at} damaged")
            read += 1
        expect(unknown <= DAMAGES // 20, f"{name}: {unknown} damaged files were read by voxtet only")
        print(f"{name}: of {DAMAGES} damaged headers {read} read the same elsewhere, {refused} refused, {unknown} unknown")


def main():
    if not DATA.is_dir():
        print(f"skipped: {DATA} is absent")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        for check in (check_shared, check_written_by_others, check_damaged):
            check(sys.argv[1], pathlib.Path(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
