#!/usr/bin/python3
"""Fields that `voxtet field` writes, read by other people's tools.

  fields.py VOXTET

An oblique, anisotropic shell of known thickness: nibabel reads size, thickness and potential from NIfTI, VTK from
ImageData. Both must find the same values at the same places, those of the shell. Then the edge lengths go back in as
an image of sizes, and the field must come out as it was. Exit 0 if all agree, 1 if not, 77 (skipped) without nibabel or
VTK.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import nibabel
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

INNER, OUTER = 10.0, 16.0
CASE = {
    "source": {
        "phantom": {
            "kind": "shell",
            "inner_radius_mm": INNER,
            "radius_mm": OUTER,
            "spacing_mm": [1, 1.2, 1.1],
            "rotation_deg": [20, 30, 40],
        }
    },
    "sizing": {"edge_mm": 2, "thickness": [{"wall": [1], "layers": 2}]},
}


def read_nifti(path):
    """Values [i, j, k] and the points of the voxels, RAS mm."""
    image = nibabel.load(path)
    values = np.asarray(image.dataobj)
    index = np.stack(np.meshgrid(*(np.arange(n) for n in values.shape), indexing="ij"), axis=-1)
    return values, nibabel.affines.apply_affine(image.affine, index)


def read_vti(path, shape):
    reader = vtk.vtkXMLImageDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    assert image.GetDimensions() == shape, (image.GetDimensions(), shape)
    values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(shape, order="F")
    corners = [(0, 0, 0), (shape[0] - 1, 0, 0), (0, shape[1] - 1, 0), (0, 0, shape[2] - 1), tuple(n - 1 for n in shape)]
    places = {}
    for corner in corners:
        mm = [0.0] * 3
        image.TransformIndexToPhysicalPoint(list(corner), mm)
        places[corner] = mm
    return values, places


def main():
    voxtet = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "case.json").write_text(json.dumps(CASE))

        def field(what, file, *options):
            subprocess.run(
                [voxtet, "field", folder / "case.json", "--what", what, "-o", folder / file, *options],
                check=True, stderr=subprocess.DEVNULL)
            return folder / file

        for what in ("size", "thickness", "potential"):
            values, points = read_nifti(field(what, what + ".nii.gz"))
            same, places = read_vti(field(what, what + ".vti"), values.shape)
            assert values.dtype == np.float32 and np.array_equal(values, same), what
            for corner, mm in places.items():
                assert np.allclose(mm, points[corner], atol=1e-4), (what, corner, mm, points[corner])
            radius = np.linalg.norm(points, axis=-1)
            wall = (radius > INNER + 1) & (radius < OUTER - 1)
            expected = {
                "size": np.full(radius.shape, (OUTER - INNER) / 2),
                "thickness": np.full(radius.shape, OUTER - INNER),
                "potential": (1 / INNER - 1 / np.maximum(radius, 1)) / (1 / INNER - 1 / OUTER),
            }[what]
            error = np.abs(values - expected)[wall].max()
            assert error < {"size": 0.4, "thickness": 0.8, "potential": 0.1}[what], (what, error)
            beyond = radius > OUTER + 2
            if what != "size":
                assert np.all(values[beyond] == {"thickness": 0, "potential": -1}[what]), what
            print(f"{what}: {wall.sum()} voxels in the wall within {error:.3f}")

        size = read_nifti(folder / "size.nii.gz")[0]
        back = read_nifti(field("size", "back.nii", "--size-image", folder / "size.nii.gz", "--set", "sizing.thickness=[]"))[0]
        assert np.abs(back - size).max() < 2e-3, np.abs(back - size).max()
        print("the size image gives its own field back")


if __name__ == "__main__":
    main()
