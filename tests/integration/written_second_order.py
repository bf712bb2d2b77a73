"""Second-order tetrahedra that voxtet writes, read by VTK, meshio, Gmsh, CalculiX and an XML parser."""
import subprocess
import xml.etree.ElementTree as ElementTree

from cube_files import expect, expect_points, run_gmsh, vtk_grid
import meshio
import numpy as np
import vtk
from written_solver_files import rows_of

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def expect_second_order(cube, points, tets, what):
    """The cube with each node on an edge at the edge's middle, and one node for each edge. `points` begin with corners."""
    expect(np.array_equal(tets[:, :4], cube.tets), f"{what}: corners")
    expect_points(points[:len(cube.points)], cube.points, what)
    ends = np.concatenate([np.sort(cube.tets[:, edge], axis=1) for edge in EDGES])
    nodes = np.concatenate([tets[:, 4 + e] for e in range(6)])
    distinct, which = np.unique(ends, axis=0, return_inverse=True)
    expect(len(points) == len(cube.points) + len(distinct), f"{what}: {len(points)} points")
    wanted = np.zeros((len(distinct), 3))
    wanted[which.ravel()] = cube.points[ends].mean(1)
    first = len(cube.points)
    expect(np.array_equal(nodes, first + which.ravel()), f"{what}: nodes shared by all elements at an edge")
    expect_points(points[first:], wanted, what)


def expect_triangles(cube, points, faces, what):
    """Faces with the middles of their edges, in any order of faces."""
    expect(len(faces) == len(cube.faces), f"{what}: {len(faces)} faces")
    for e, edge in enumerate(EDGES[:3]):
        expect_points(points[faces[:, 3 + e]], points[faces[:, edge]].mean(1), f"{what}: edge {e} of faces")


def check_vtk(cube, folder, space):
    _, points, cells, types = vtk_grid(folder / f"{space}_order2.vtu")
    expect((types == vtk.VTK_QUADRATIC_TETRA).all(), "second-order VTU: types")
    expect_second_order(cube, points, cells.reshape(-1, 10), "second-order VTU by VTK")
    _, points, cells, types = vtk_grid(folder / f"{space}_order2.surfaces.vtu")
    expect((types == vtk.VTK_QUADRATIC_TRIANGLE).all(), "second-order surface VTU: types")
    expect_triangles(cube, points, cells.reshape(-1, 6), "second-order surface VTU by VTK")


def least_scaled_jacobian(path):
    """The least of all elements, as Gmsh computes it: the least over the greatest determinant within one."""
    script = path.with_suffix(".geo")
    script.write_text(f'Merge "{path.name}";\nPlugin(AnalyseMeshQuality).JacobianDeterminant = 1;\n'
                      "Plugin(AnalyseMeshQuality).DimensionOfElements = 3;\nPlugin(AnalyseMeshQuality).Run;\n")
    worst = next(line for line in run_gmsh(script, "-").splitlines() if "minJ/maxJ" in line and "(worst" in line)
    return float(worst.split("=")[1].split(",")[0])


def check_gmsh(cube, folder, space):
    """Gmsh's own order of nodes: its Jacobian determinants would change within elements where it were another one."""
    for name in (f"{space}_order2", f"{space}_order2_22"):
        path = folder / f"{name}.msh"
        mesh = meshio.read(path)
        order = np.lexsort(mesh.points.T)
        wanted = np.concatenate([cube.points, middles(cube)])
        expect_points(mesh.points[order], wanted[np.lexsort(wanted.T)], f"{name} by meshio")
        for e, edge in enumerate(EDGES):
            tets = mesh.cells_dict["tetra10"]
            expect_points(mesh.points[tets[:, 4 + e]], mesh.points[tets[:, edge]].mean(1), f"{name}: edge {e}")
        expect_triangles(cube, mesh.points, mesh.cells_dict["triangle6"], f"{name} by meshio")
        expect(least_scaled_jacobian(path) > 1 - 1e-6, f"{name} by gmsh: straight elements whose Jacobian changes")


def middles(cube):
    ends = np.unique(np.concatenate([np.sort(cube.tets[:, edge], axis=1) for edge in EDGES]), axis=0)
    return cube.points[ends].mean(1)


def check_solvers(cube, folder, space):
    path = folder / f"{space}_order2.inp"
    expect("TYPE=C3D10" in path.read_text(encoding="ascii"), "second-order Abaqus: type")
    mesh = meshio.read(path)
    tets = np.concatenate([block.data for block in mesh.cells])
    rows = [line.split(", ") for line in path.read_text(encoding="ascii").splitlines() if line.count(",") == 10]
    numbers = np.array([int(row[0]) - 1 for row in rows])
    ordered = np.empty_like(tets)
    ordered[numbers] = tets
    expect_second_order(cube, mesh.points, ordered, "second-order Abaqus by meshio")
    root = ElementTree.parse(folder / f"{space}_order2.feb").getroot()
    expect({part.get("type") for part in root.iter("Elements")} == {"tet10"}, "second-order FEBio: type")
    _, points = rows_of(root.find("Mesh/Nodes"))
    for part in root.iter("Elements"):
        ids, nodes = rows_of(part)
        ordered[ids] = nodes - 1
    expect_second_order(cube, points, ordered, "second-order FEBio")
    for surface in root.iter("Surface"):
        expect({row.tag for row in surface} == {"tri6"}, "second-order FEBio: type of faces")
    mesh = meshio.read(folder / f"{space}_order2.xdmf")
    expect_second_order(cube, mesh.points, mesh.cells_dict["tetra10"], "second-order XDMF by meshio")
    mesh = meshio.read(folder / f"{space}_order2.facets.xdmf")
    expect_triangles(cube, mesh.points, mesh.cells_dict["triangle6"], "second-order XDMF facets by meshio")


def check_calculix(cube, folder, space):
    """CalculiX integrates the elements with its own shape functions: it stops at a determinant that is not positive."""
    deck = [f"*INCLUDE, INPUT={space}_order2.inp", "*MATERIAL, NAME=MATERIAL", "*ELASTIC", "1, 0.3"]
    text = (folder / f"{space}_order2.inp").read_text(encoding="ascii")
    parts = [line.split("ELSET=")[1] for line in text.splitlines() if "ELSET=" in line]
    deck += [f"*SOLID SECTION, ELSET={part}, MATERIAL=MATERIAL" for part in parts]
    deck += ["*BOUNDARY", *[f"{node + 1}, 1, 3" for node in cube.tets[0][:3]], "*STEP", "*STATIC"]
    for part in parts:
        deck += [f"*EL PRINT, ELSET={part}, TOTALS=ONLY", "EVOL"]
    (folder / f"{space}_order2_deck.inp").write_text("\n".join([*deck, "*END STEP", ""]))
    done = subprocess.run(["ccx", f"{space}_order2_deck"], cwd=folder, capture_output=True, text=True, check=False)
    expect(done.returncode == 0 and "*ERROR" not in done.stdout, f"CalculiX complains: {done.stdout}{done.stderr}")
    printed = (folder / f"{space}_order2_deck.dat").read_text(encoding="utf-8").splitlines()
    found = sum(float(line) for line in printed if "E+" in line and " set " not in line)
    p = cube.points[cube.tets]
    wanted = np.einsum("ij,ij->i", p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0])).sum() / 6
    expect(abs(found / wanted - 1) < 1e-5, f"CalculiX: volume {found}, expected {wanted}")


CHECKS = (check_vtk, check_gmsh, check_solvers, check_calculix)
