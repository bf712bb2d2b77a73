"""Legacy VTK, MSH 2.2, Nastran, TetGen, an STL for each label and facet tags as voxtet writes them, read by VTK, meshio
and Gmsh."""
from cube_files import EXACT_MM, FLOAT_RELATIVE, expect, expect_points, expect_positive, expect_same_cells, run_gmsh
from written_meshes import CELL_DATA, cell_array, expect_cell_data, expect_groups
import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

# Fields of 16 characters hold twelve decimals of "-12."
NASTRAN_MM = 1e-12


def check_vtk(cube, folder, space):
    path = folder / f"{space}.vtk"
    reader = vtk.vtkUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.ReadAllFieldsOn()
    reader.ReadAllScalarsOn()
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    expect(points.dtype == np.float64, "VTK: type of points")
    expect_points(points, cube.points, "VTK by VTK")
    expect((cells == cube.tets).all(), "VTK by VTK: tetrahedra")
    expect((cell_array(grid, "label") == cube.labels).all(), "VTK by VTK: labels")
    for name in CELL_DATA:
        expect_cell_data(cube, vtk_to_numpy(grid.GetCellData().GetArray(name)), name, "VTK by VTK")
    names = bytes(vtk_to_numpy(grid.GetFieldData().GetArray("label_names")).astype(np.uint8)).split(b"\0")[:-1]
    expect([name.decode() for name in names] == ["LV myocardium", "veine \"cave\" | sup\u00e9rieure"],
           f"VTK by VTK: names {names}")
    expect(path.read_text(encoding="utf-8").splitlines()[1].startswith(f"voxtet mesh, space {space.upper()}, unit mm"), "VTK: space")
    mesh = meshio.read(path)
    expect_points(mesh.points, cube.points, "VTK by meshio")
    expect((mesh.cells_dict["tetra"] == cube.tets).all(), "VTK by meshio: tetrahedra")
    expect((mesh.cell_data["label"][0].ravel() == cube.labels).all(), "VTK by meshio: labels")
    surface = meshio.read(folder / f"{space}_surface.vtk")
    expect((surface.cells_dict["triangle"] == cube.faces).all(), "surface VTK by meshio: triangles")
    for side, name in enumerate(("label_behind", "label_front")):
        expect((surface.cell_data[name][0].ravel() == cube.sides[:, side]).all(), f"surface VTK by meshio: {name}")


def check_msh22(cube, folder, space):
    path = folder / f"{space}_22.msh"
    expect_groups(meshio.read(path), cube, "MSH 2.2 by meshio")
    said = run_gmsh("-0", path, "-format", "msh41", "-o", folder / f"{space}_22_to_41.msh")
    expect(f"{len(cube.points)} nodes" in said, f"MSH 2.2 by Gmsh: {said}")
    expect_groups(meshio.read(folder / f"{space}_22_to_41.msh"), cube, "MSH 2.2 by Gmsh")


def check_nastran(cube, folder, space):
    path = folder / f"{space}.bdf"
    mesh = meshio.read(path)
    expect_points(mesh.points, cube.points, "Nastran by meshio", NASTRAN_MM)
    expect((mesh.cells_dict["tetra"] == cube.tets).all(), "Nastran by meshio: tetrahedra")
    expect((mesh.cell_data["nastran:ref"][0] == cube.labels).all(), "Nastran by meshio: labels")
    # Loads on the elements behind the faces, on the side opposite to a corner.
    loads = np.array([[int(line[a:b]) for a, b in ((8, 16), (16, 24), (56, 64), (64, 72))]
                      for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("PLOAD4")])
    expect((loads[:, 0] == cube.pair_rank).all(), "Nastran: load sets")
    tets = cube.tets[loads[:, 1] - 1]
    expect((cube.labels[loads[:, 1] - 1] == cube.sides[:, 0]).all(), "Nastran: elements of loads")
    rest = np.sort(tets[tets != loads[:, 3:] - 1].reshape(-1, 3))
    expect((rest == np.sort(cube.faces)).all() and (loads[:, 2] - 1 == cube.faces[:, 0]).all(), "Nastran: sides of loads")


def check_tetgen(cube, folder, space):
    mesh = meshio.read(folder / f"{space}.node")
    expect_points(mesh.points, cube.points, "TetGen by meshio")
    expect((mesh.cells_dict["tetra"] == cube.tets).all(), "TetGen by meshio: tetrahedra")
    expect((mesh.cell_data["tetgen:ref"][0] == cube.labels).all(), "TetGen by meshio: labels")
    lines = [line for line in (folder / f"{space}.face").read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    faces = np.array([line.split() for line in lines[1:]], int)
    expect((faces[:, 1:4] - 1 == cube.faces).all() and (faces[:, 4] == cube.pair_rank).all(), "TetGen: faces")


def check_label_stls(cube, folder, space):
    names = {1: "LV_myocardium_1", 7: "label_7", 300: "veine_cave_sup_rieure_300"}
    p = cube.points[cube.tets]
    volumes = np.einsum("ij,ij->i", p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0])) / 6
    for label, name in names.items():
        mesh = meshio.read(folder / f"{space}_label.{name}.stl")
        cells = mesh.cells_dict["triangle"]
        edges = np.concatenate([cells[:, [0, 1]], cells[:, [1, 2]], cells[:, [2, 0]]])
        expect((np.unique(np.sort(edges), axis=0, return_counts=True)[1] % 2 == 0).all(), f"STL of {name}: not closed")
        q = mesh.points[cells].astype(np.float64)
        enclosed = np.einsum("ij,ij->i", q[:, 0], np.cross(q[:, 1], q[:, 2])).sum() / 6
        wanted = volumes[cube.labels == label].sum()
        expect(abs(enclosed / wanted - 1) < 100 * FLOAT_RELATIVE, f"STL of {name}: {enclosed} mm3, expected {wanted}")


def check_facets(cube, folder, space):
    mesh = meshio.read(folder / f"{space}.facets.xdmf")
    expect_points(mesh.points, cube.points, "facets by meshio", EXACT_MM)
    expect_same_cells((mesh.points, mesh.cells_dict["triangle"], mesh.cell_data["facet"][0]),
                      (cube.points, cube.faces, cube.pair_rank), "facets by meshio")
    expect_positive(cube.points, cube.tets, "facets")


CHECKS = (check_vtk, check_msh22, check_nastran, check_tetgen, check_label_stls, check_facets)
