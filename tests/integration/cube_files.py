"""The cube of tests/support/labelled_mesh.h and what is expected of files that hold it. Ends with exit code 77 where
something that this needs is absent."""
import shutil
import subprocess
import sys

try:
    import h5py  # these two for those that import this
    import meshio
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
for program in ("gmsh", "ccx"):
    if not shutil.which(program):
        print(f"skipped: no {program} on the path")
        sys.exit(77)

EXACT_MM = 1e-12
FLOAT_RELATIVE = 1e-6
NAMES = {1: "LV myocardium", 7: "label 7", 300: "veine 'cave' / sup\u00e9rieure", 0: "background"}


def expect(condition, sentence):
    if not condition:
        raise AssertionError(sentence)


class Cube:
    """The numbers that the files must hold, in one space."""

    def __init__(self, folder, space):
        self.points = np.fromfile(folder / "raw.points").reshape(-1, 3)
        if space == "lps":
            self.points = self.points * [-1, -1, 1]
        self.tets = np.fromfile(folder / "raw.tets", "<u4").reshape(-1, 4).astype(np.int64)
        self.labels = np.fromfile(folder / "raw.labels", "<u2").astype(np.int64)
        self.faces = np.fromfile(folder / "raw.faces", "<u4").reshape(-1, 3).astype(np.int64)
        self.sides = np.fromfile(folder / "raw.sides", "<u2").reshape(-1, 2).astype(np.int64)
        self.pairs = sorted({tuple(pair) for pair in self.sides.tolist()})
        self.pair_rank = np.array([self.pairs.index(tuple(pair)) + 1 for pair in self.sides.tolist()])
        self.group_names = {(3, label): NAMES[label] for label in set(self.labels.tolist())}
        for rank, (behind, front) in enumerate(self.pairs, 1):
            self.group_names[(2, rank)] = f"{NAMES[behind]}|{NAMES[front]}"


def expect_points(found, wanted, what, tolerance=EXACT_MM):
    expect(found.shape == wanted.shape, f"{what}: points of shape {found.shape}, expected {wanted.shape}")
    worst = np.abs(found - wanted).max()
    expect(worst <= tolerance, f"{what}: points differ by {worst} mm")


def expect_positive(points, tets, what):
    p = points[tets]
    volumes = np.einsum("ij,ij->i", p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0]))
    expect((volumes > 0).all(), f"{what}: {int((volumes <= 0).sum())} tetrahedra are not positive")


def sorted_cells(points, cells, attribute):
    """Corners and attribute of each cell in an order that depends on places alone: equal for equal meshes whatever the
    order of points and cells. Triangles begin at their least corner; the corners of tetrahedra stay as they are."""
    corners = points[cells]
    keys = np.round(corners, 9) + 0.0
    if cells.shape[1] == 3:
        first = np.array([min(range(3), key=lambda c, row=row: tuple(row[c])) for row in keys])
        order = (first[:, None] + np.arange(3)) % 3
        corners = np.take_along_axis(corners, order[:, :, None], axis=1)
        keys = np.take_along_axis(keys, order[:, :, None], axis=1)
    order = np.lexsort(keys.reshape(len(cells), -1).T[::-1])
    return corners[order], np.asarray(attribute)[order]


def expect_same_cells(found, wanted, what, tolerance=EXACT_MM):
    """Both: (points, cells, attribute)."""
    (corners, attribute), (wanted_corners, wanted_attribute) = sorted_cells(*found), sorted_cells(*wanted)
    expect_points(corners, wanted_corners, what, tolerance)
    expect((attribute == wanted_attribute).all(), f"{what}: labels or groups of cells")


def vtk_grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    expect(reader.GetErrorCode() == 0, f"VTK cannot read {path.name}")
    grid = reader.GetOutput()
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    types = vtk_to_numpy(grid.GetCellTypesArray())
    return grid, vtk_to_numpy(grid.GetPoints().GetData()), cells, types


def run_gmsh(*arguments, tolerated="\0"):
    done = subprocess.run(["gmsh", *map(str, arguments)], capture_output=True, text=True, check=False)
    said = (done.stdout + done.stderr).replace(tolerated, "")
    expect(done.returncode == 0, f"gmsh {arguments} ended with {done.returncode}: {said}")
    expect("Warning" not in said and "Error" not in said, f"gmsh {arguments} complains: {said}")
    return said
