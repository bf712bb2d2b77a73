"""What voxtet writes, read by VTK, meshio, Gmsh and numpy parsers."""
from cube_files import (EXACT_MM, FLOAT_RELATIVE, NAMES, expect, expect_points, expect_positive, expect_same_cells,
                        run_gmsh, vtk_grid)
import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


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
    expect(f"<!-- space {space.upper()}, unit mm".encode() in path.read_bytes(), "VTU: space and unit")
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


def check_msh(cube, folder, space):
    path = folder / f"{space}.msh"
    mesh = meshio.read(path)
    expect_groups(mesh, cube, "MSH by meshio")
    expect(f"$Comments\nspace {space.upper()}\nunit mm\n$EndComments".encode() in path.read_bytes(),
           "MSH: space and unit")
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
                for line in saved.read_text(encoding="utf-8").splitlines() if line.startswith("SS(")]
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
    lines = copy.read_text(encoding="utf-8").split("$Entities\n")[1].split("$EndEntities")[0].splitlines()
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
    expect(f"# space {space.upper()}\n# unit mm\n" in text, "MEDIT: space and unit")
    for (dimension, tag), name in cube.group_names.items():
        expect(f"# {'tetrahedra' if dimension == 3 else 'triangles'} {tag} {name}\n" in text, f"MEDIT: name {name}")
    words = (folder / f"{space}.sol").read_text(encoding="utf-8").split("SolAtTetrahedra")[1].split()
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
        lines = (folder / f"{space}{ending}").read_text(encoding="utf-8").splitlines()
        return int(lines[0]), [line.split() for line in lines[1:]]

    count, points = rows(".pts")
    expect(count == len(points) == len(cube.points), "openCARP: number of points")
    expect_points(np.array(points, float) / 1000, cube.points, "openCARP")
    count, elements = rows(".elem")
    expect(count == len(elements) and {row[0] for row in elements} == {"Tt"}, "openCARP: elements")
    numbers = np.array([row[1:] for row in elements], int)
    expect((numbers[:, :4] == cube.tets).all() and (numbers[:, 4] == cube.labels).all(), "openCARP: tetrahedra, regions")
    expect(not (folder / f"{space}.lon").exists(), "openCARP: no fibres where none are known")
    expect("no fibres" in (folder / f"{space}.lon.txt").read_text(encoding="utf-8"), "openCARP: a word on missing fibres")
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
        expect(f"space {space.upper()}, unit mm".encode() in path.read_bytes()[:80], "STL: space and unit")
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
        expect({f"space {space.upper()}", "unit mm"} < set(comments) and f"label 1 {NAMES[1]}" in comments, f"PLY: comments {comments}")


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


CHECKS = (check_vtu, check_msh, check_medit, check_carp, check_stl_and_ply)
