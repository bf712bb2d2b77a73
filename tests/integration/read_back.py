"""Reads every mesh format that voxtet writes with tools of other people, and lets voxtet read what those write.

Sample run: read_back.py build/native/tests/unit/io/mesh_files

1. VTK, meshio, Gmsh and numpy parsers read the cube of tests/support/labelled_mesh.h, in RAS and LPS: points to 1e-12 mm
   (32-bit formats: 1e-6 of their size), tetrahedra, labels, sides, names of groups, positive volumes, cell data.
2. VTK, meshio and Gmsh write the cube in every variant of their formats; voxtet must read the same mesh.
Exit code 77: something that this needs is absent.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import meshio
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
if not shutil.which("gmsh"):
    print("skipped: no gmsh on the path")
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


def cell_array(grid, name):
    array = grid.GetCellData().GetArray(name)
    expect(array is not None, f"no cell array {name}")
    return vtk_to_numpy(array).astype(np.int64)


def cell_data_of(cube, name):
    """The arrays of cube_cell_data in tests/support/labelled_mesh.h."""
    count = np.float32(len(cube.tets))
    return (cube.labels if name == "majority_label" else np.arange(count) / count).astype(np.float32)


def expect_cell_data(cube, values, name, what):
    expect((np.asarray(values, np.float32).ravel() == cell_data_of(cube, name)).all(), f"{what}: cell data {name}")


CELL_DATA = ("majority_label", "fraction_300")


def check_vtu(cube, folder, space):
    path = folder / f"{space}.vtu"
    grid, points, cells, types = vtk_grid(path)
    expect(points.dtype == np.float64 and (types == vtk.VTK_TETRA).all(), "VTU: type of points or cells")
    expect_points(points, cube.points, "VTU by VTK")
    expect((cells.reshape(-1, 4) == cube.tets).all(), "VTU by VTK: tetrahedra")
    expect((cell_array(grid, "label") == cube.labels).all(), "VTU by VTK: labels")
    for name in CELL_DATA:
        expect_cell_data(cube, vtk_to_numpy(grid.GetCellData().GetArray(name)), name, "VTU by VTK")
    said = grid.GetFieldData().GetArray("space")
    expect((said is None) == (space == "ras"), "VTU by VTK: whether the field data say a space")
    if said is not None:
        expect(bytes(vtk_to_numpy(said).astype(np.uint8)) == b"LPS", "VTU by VTK: the space")
    expect_positive(points, cells.reshape(-1, 4), "VTU")
    mesh = meshio.read(path)
    expect_points(mesh.points, cube.points, "VTU by meshio")
    expect((mesh.cells_dict["tetra"] == cube.tets).all(), "VTU by meshio: tetrahedra")
    expect((mesh.cell_data["label"][0] == cube.labels).all(), "VTU by meshio: labels")
    for name in CELL_DATA:
        expect_cell_data(cube, mesh.cell_data[name][0], name, "VTU by meshio")

    path = folder / f"{space}_surface.vtu"
    grid, points, cells, types = vtk_grid(path)
    expect((types == vtk.VTK_TRIANGLE).all(), "surface VTU: types")
    expect_points(points, cube.points, "surface VTU by VTK")
    expect((cells.reshape(-1, 3) == cube.faces).all(), "surface VTU by VTK: triangles")
    for name, side in (("label_behind", 0), ("label_front", 1)):
        expect((cell_array(grid, name) == cube.sides[:, side]).all(), f"surface VTU by VTK: {name}")
    mesh = meshio.read(path)
    expect((mesh.cells_dict["triangle"] == cube.faces).all(), "surface VTU by meshio: triangles")
    expect((mesh.cell_data["label_front"][0] == cube.sides[:, 1]).all(), "surface VTU by meshio: label_front")


def expect_groups(mesh, cube, what):
    """A mesh that meshio read, with physical groups."""
    names = {(int(dim), int(tag)): name for name, (tag, dim) in mesh.field_data.items()}
    expect(names == cube.group_names, f"{what}: physical groups {names}")
    tags = mesh.cell_data_dict["gmsh:physical"]
    expect_same_cells((mesh.points, mesh.cells_dict["tetra"], tags["tetra"]), (cube.points, cube.tets, cube.labels), what)
    expect_same_cells((mesh.points, mesh.cells_dict["triangle"], tags["triangle"]),
                      (cube.points, cube.faces, cube.pair_rank), what)
    expect_positive(mesh.points, mesh.cells_dict["tetra"], what)


def run_gmsh(*arguments, tolerated="\0"):
    done = subprocess.run(["gmsh", *map(str, arguments)], capture_output=True, text=True, check=False)
    said = (done.stdout + done.stderr).replace(tolerated, "")
    expect(done.returncode == 0, f"gmsh {arguments} ended with {done.returncode}: {said}")
    expect("Warning" not in said and "Error" not in said, f"gmsh {arguments} complains: {said}")
    return said


def check_msh(cube, folder, space):
    path = folder / f"{space}.msh"
    mesh = meshio.read(path)
    expect_groups(mesh, cube, "MSH by meshio")
    expect(len(np.unique(mesh.points, axis=0)) == len(cube.points), "MSH by meshio: number of points")
    said = run_gmsh("-check", path, "-")
    expect(f"{len(cube.points)} nodes" in said, f"MSH by gmsh -check: {said}")
    copy = folder / f"{space}_by_gmsh22.msh"
    run_gmsh("-0", path, "-format", "msh22", "-o", copy)
    expect_groups(meshio.read(copy), cube, "MSH by gmsh, saved as 2.2")
    check_element_data(cube, folder, space)
    check_boxes(cube, folder, space)


def check_element_data(cube, folder, space):
    """The views that Gmsh makes of the second file, saved as text by Gmsh: corners and value of each tetrahedron."""
    for view, name in enumerate(CELL_DATA):
        script, saved = folder / f"{space}_view.geo", folder / f"{space}_{name}.pos"
        script.write_text(f'Merge "{space}.msh";\nMerge "{space}_data.msh";\nSave View[{view}] "{saved.name}";\n')
        run_gmsh(script, "-", tolerated="Warning : Discarding interpolation matrices")
        rows = [line[3:].replace("){", ",").split("}")[0].split(",")
                for line in saved.read_text().splitlines() if line.startswith("SS(")]
        numbers = np.array(rows, float)
        expect(len(numbers) == len(cube.tets), f"MSH by gmsh: {len(numbers)} values of {name}")
        found = numbers[:, :12].reshape(-1, 4, 3).mean(1), numbers[:, 12]
        wanted = cube.points[cube.tets].mean(1), cell_data_of(cube, name)
        orders = [np.lexsort(np.round(centres, 6).T) for centres, _ in (found, wanted)]
        for what in (0, 1):
            worst = np.abs(found[what][orders[0]] - wanted[what][orders[1]]).max()
            expect(worst < 1e-4, f"MSH by gmsh: cell data {name} differ by {worst}")


def check_boxes(cube, folder, space):
    """The $Entities of an ASCII copy that Gmsh makes: boxes of the groups, and surfaces that bound volumes."""
    copy = folder / f"{space}_by_gmsh41.msh"
    run_gmsh("-0", folder / f"{space}.msh", "-format", "msh41", "-o", copy)
    lines = copy.read_text().split("$Entities\n")[1].split("$EndEntities")[0].splitlines()
    expect([int(n) for n in lines[0].split()] == [0, 0, len(cube.pairs), len(set(cube.labels.tolist()))],
           f"MSH by gmsh: numbers of entities {lines[0]}")
    for line in lines[1:]:
        words = line.split()
        tag, box, groups = int(words[0]), np.array(words[1:7], float), int(words[7])
        bounds = [int(word) for word in words[9 + groups:]]
        volume = len(lines) - lines.index(line) <= len(set(cube.labels.tolist()))
        cells = cube.tets[cube.labels == tag] if volume else cube.faces[cube.pair_rank == tag]
        points = cube.points[np.unique(cells)]
        expect(np.abs(box - np.concatenate([points.min(0), points.max(0)])).max() < 1e-9, f"MSH: box of entity {tag}")
        expect(words[7:9] == ["1", str(tag)], f"MSH: physical group of entity {tag}")
        wanted = [(n + 1) * (1 if pair[0] == tag else -1) for n, pair in enumerate(cube.pairs) if tag in pair]
        if volume:
            expect(sorted(map(abs, bounds)) == sorted(map(abs, wanted)), f"MSH: surfaces of volume {tag}: {bounds}")


def check_medit(cube, folder, space):
    path = folder / f"{space}.mesh"
    mesh = meshio.read(path)
    expect_points(mesh.points, cube.points, "MEDIT by meshio")
    references = mesh.cell_data_dict["medit:ref"]
    expect((mesh.cells_dict["tetra"] == cube.tets).all(), "MEDIT by meshio: tetrahedra")
    expect((references["tetra"] == cube.labels).all(), "MEDIT by meshio: references of tetrahedra")
    expect((mesh.cells_dict["triangle"] == cube.faces).all(), "MEDIT by meshio: triangles")
    expect((references["triangle"] == cube.pair_rank).all(), "MEDIT by meshio: references of triangles")
    text = path.read_text(encoding="utf-8")
    expect(f"# space {space.upper()}\n" in text, "MEDIT: space")
    for (dimension, tag), name in cube.group_names.items():
        expect(f"# {'tetrahedra' if dimension == 3 else 'triangles'} {tag} {name}\n" in text, f"MEDIT: name {name}")
    words = (folder / f"{space}.sol").read_text().split("SolAtTetrahedra")[1].split()
    expect(words[:4] == [str(len(cube.tets)), "2", "1", "1"] and words[-1] == "End", f"MEDIT: solution {words[:4]}")
    columns = np.array(words[4:-1], float).reshape(-1, 2)
    for column, name in enumerate(CELL_DATA):
        expect_cell_data(cube, columns[:, column], name, "MEDIT solution")
    copy = folder / f"{space}_mesh_by_gmsh.msh"
    run_gmsh("-0", path, "-format", "msh22", "-o", copy, "-save_all")
    by_gmsh = meshio.read(copy)
    expect_same_cells((by_gmsh.points, by_gmsh.cells_dict["tetra"], by_gmsh.cell_data_dict["gmsh:geometrical"]["tetra"]),
                      (cube.points, cube.tets, cube.labels), "MEDIT by gmsh")


def check_carp(cube, folder, space):
    def rows(ending):
        lines = (folder / f"{space}{ending}").read_text().splitlines()
        return int(lines[0]), [line.split() for line in lines[1:]]

    count, points = rows(".pts")
    expect(count == len(points) == len(cube.points), "openCARP: number of points")
    expect_points(np.array(points, float) / 1000, cube.points, "openCARP")
    count, elements = rows(".elem")
    expect(count == len(elements) and {row[0] for row in elements} == {"Tt"}, "openCARP: elements")
    numbers = np.array([row[1:] for row in elements], int)
    expect((numbers[:, :4] == cube.tets).all() and (numbers[:, 4] == cube.labels).all(), "openCARP: tetrahedra, regions")
    count, axes = rows(".lon")
    expect(count == 1 and len(axes) == len(cube.tets), "openCARP: number of fibre axes")
    expect((np.array(axes, float) == [1, 0, 0]).all(), "openCARP: fibres")
    for name in CELL_DATA:
        expect_cell_data(cube, np.loadtxt(folder / f"{space}.{name}.dat"), name, "openCARP")


def vtk_polydata(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    expect(data.GetNumberOfPoints() > 0, f"VTK cannot read {path.name}")
    return (vtk_to_numpy(data.GetPoints().GetData()).astype(float),
            vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def check_stl_and_ply(cube, folder, space):
    float_mm = FLOAT_RELATIVE * np.abs(cube.points).max()
    wanted = cube.points[cube.faces]
    used = np.unique(cube.faces)
    for name in (space, f"{space}_surface"):
        path = folder / f"{name}.stl"
        reader = vtk.vtkSTLReader()
        reader.MergingOff()
        points, triangles = vtk_polydata(reader, path)
        expect_points(points[triangles], wanted, "STL by VTK", float_mm)
        mesh = meshio.read(path)
        expect_points(mesh.points[mesh.cells_dict["triangle"]], wanted, "STL by meshio", float_mm)
        normals = np.cross(wanted[:, 1] - wanted[:, 0], wanted[:, 2] - wanted[:, 0])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        stored = np.fromfile(path, record, offset=84)["normal"]
        expect(np.abs(stored - normals).max() < 1e-6, "STL: normals")

        path = folder / f"{name}.ply"
        points, triangles = vtk_polydata(vtk.vtkPLYReader(), path)
        expect_points(points[triangles], wanted, "PLY by VTK", float_mm)
        points, triangles, sides, comments = numpy_ply(path)
        expect_points(points, cube.points[used] if name == space else cube.points, "PLY by numpy", 0)
        expect((points[triangles] == wanted).all() and (sides == cube.sides).all(), "PLY by numpy: triangles, sides")
        expect(f"space {space.upper()}" in comments and f"label 1 {NAMES[1]}" in comments, f"PLY: comments {comments}")


def numpy_ply(path):
    """meshio 5.0 reads no binary PLY whose faces have properties besides their corners."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    lines = header.decode("utf-8").splitlines()
    expect(lines[:2] == ["ply", "format binary_little_endian 1.0"], "PLY: first lines")
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    expect([line for line in lines if line.startswith("property")] ==
           [f"property double {axis}" for axis in "xyz"] + ["property list uchar int vertex_indices",
                                                            "property ushort label_behind", "property ushort label_front"],
           "PLY: properties")
    face = np.dtype([("n", "u1"), ("corners", "<i4", 3), ("sides", "<u2", 2)])
    points = np.frombuffer(body, "<f8", 3 * counts["vertex"]).reshape(-1, 3)
    faces = np.frombuffer(body, face, counts["face"], points.nbytes)
    expect(len(body) == points.nbytes + faces.nbytes and (faces["n"] == 3).all(), "PLY: size")
    comments = [line[len("comment "):] for line in lines if line.startswith("comment ")]
    return points, faces["corners"], faces["sides"], comments


def expect_voxtet_reads(tool, path, cube, what, ordered=True, tolerance=0.0):
    out = path.with_suffix(path.suffix + ".read")
    done = subprocess.run([tool, "read", str(path), str(out)], capture_output=True, text=True, check=False)
    expect(done.returncode == 0, f"voxtet cannot read {what}: {done.stderr}")
    points = np.fromfile(f"{out}.points").reshape(-1, 3)
    tets = np.fromfile(f"{out}.tets", "<u4").reshape(-1, 4)
    labels = np.fromfile(f"{out}.labels", "<u2")
    if ordered:
        expect_points(points, cube.points, what, tolerance)
        expect((tets == cube.tets).all() and (labels == cube.labels).all(), f"{what}: tetrahedra or labels")
    else:
        expect_same_cells((points, tets, labels), (cube.points, cube.tets, cube.labels), what)


def check_reading_vtk(tool, cube, folder):
    """VTK's writer in every combination of encoding, compression and header size; and RAS told from LPS."""
    for space in ("ras", "lps"):
        grid = vtk_grid(folder / f"{space}.vtu")[0]
        for mode in ("Ascii", "Binary", "Appended"):
            for compressor in ("None", "ZLib"):
                for bits in (32, 64):
                    for raw in ((True, False) if mode == "Appended" else (True,)):
                        path = folder / f"vtk_{space}_{mode}_{compressor}_{bits}_{raw}.vtu"
                        writer = vtk.vtkXMLUnstructuredGridWriter()
                        writer.SetFileName(str(path))
                        writer.SetInputData(grid)
                        getattr(writer, f"SetDataModeTo{mode}")()
                        getattr(writer, f"SetCompressorTypeTo{compressor}")()
                        getattr(writer, f"SetHeaderTypeToUInt{bits}")()
                        writer.SetBlockSize(4800)
                        writer.SetEncodeAppendedData(not raw)
                        expect(writer.Write() == 1, f"VTK cannot write {path.name}")
                        tolerance = EXACT_MM if mode == "Ascii" else 0.0
                        expect_voxtet_reads(tool, path, cube, path.name, tolerance=tolerance)
    grid = vtk_grid(folder / "ras.vtu")[0]
    said = vtk.vtkStringArray()
    said.SetName("space")
    said.InsertNextValue("LPS")
    grid.GetFieldData().AddArray(said)
    flipped = vtk.vtkPoints()
    flipped.SetDataTypeToDouble()
    flipped.SetData(numpy_to_vtk(cube.points * [-1, -1, 1], deep=True))
    grid.SetPoints(flipped)
    for mode in ("Ascii", "Binary", "Appended"):
        path = folder / f"vtk_string_{mode}.vtu"
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(path))
        writer.SetInputData(grid)
        getattr(writer, f"SetDataModeTo{mode}")()
        writer.Write()
        expect_voxtet_reads(tool, path, cube, path.name, tolerance=EXACT_MM if mode == "Ascii" else 0.0)


def check_reading_meshio(tool, cube, folder):
    cells = [("triangle", cube.faces), ("tetra", cube.tets)]

    def mesh(name):
        data = {name: [cube.pair_rank, cube.labels]}
        if name.startswith("gmsh"):
            data["gmsh:geometrical"] = data[name]
        return meshio.Mesh(cube.points, cells, cell_data=data)

    for compression in (None, "zlib"):
        path = folder / f"meshio_{compression}.vtu"
        meshio.vtu.write(path, mesh("label"), compression=compression)
        expect_voxtet_reads(tool, path, cube, path.name)
    path = folder / "meshio_ascii.vtu"
    meshio.vtu.write(path, mesh("label"), binary=False)
    expect_voxtet_reads(tool, path, cube, path.name, tolerance=1e-9)
    path = folder / "meshio.mesh"
    meshio.write(path, mesh("medit:ref"), file_format="medit")
    expect_voxtet_reads(tool, path, cube, path.name, tolerance=EXACT_MM)
    for binary in (False, True):
        path = folder / f"meshio_22_{binary}.msh"
        meshio.gmsh.write(path, mesh("gmsh:physical"), "2.2", binary=binary)
        expect_voxtet_reads(tool, path, cube, path.name, tolerance=EXACT_MM)


def check_reading_gmsh(tool, cube, folder):
    for version in ("msh22", "msh41"):
        for binary in ([], ["-bin"]):
            for everything in ([], ["-save_all"]):
                name = f"gmsh_{version}{''.join(binary)}{''.join(everything)}.msh"
                run_gmsh("-0", folder / "ras.msh", "-format", version, *binary, *everything, "-o", folder / name)
                if everything and version == "msh22":
                    continue  # saves no physical groups
                expect_voxtet_reads(tool, folder / name, cube, name, ordered=False)


def main():
    tool = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([tool, "write", name], check=True)
        for space in ("ras", "lps"):
            cube = Cube(folder, space)
            for check in (check_vtu, check_msh, check_medit, check_carp, check_stl_and_ply):
                check(cube, folder, space)
        cube = Cube(folder, "ras")
        for check in (check_reading_vtk, check_reading_meshio, check_reading_gmsh):
            check(tool, cube, folder)
        print(f"{len(cube.tets)} tetrahedra, {len(cube.faces)} faces: {len(list(folder.iterdir()))} files agree")


if __name__ == "__main__":
    main()
