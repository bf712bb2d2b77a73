#!/usr/bin/python3
"""Cases of mechanics for FEBio and svMultiPhysics, read here from their files alone.

  mechanics_case.py VOXTET

A small heart of two ventricles with fibres and scar is written for both. Then

1. the .feb, as XML, and the meshes, as VTK reads them, are the .vtu that voxtet writes of the same case: points,
   tetrahedra, fibres, and the triangles of each named surface with the tetrahedra behind them, normals outwards;
2. of every text that names another part of a case, that part is there: materials, surfaces, load curves, files;
3. second-order elements for FEBio have their nodes in its order;
4. where dolfinx is installed, each case is solved from its numbers, with the energy that the program's manual gives for
   its material, and displacements are those with voxtet's own energy, within 1 %.

Exit 0 if all agree, 1 if not, 77 (skipped) without numpy or VTK.
"""
import json
import logging
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench/peers"))

CASE = {
    "source": {"phantom": {"kind": "biventricle", "scale": 0.5, "scar": True, "roughness_mm": 0}},
    "labels": [1, 2, 5, 6],
    "sizing": {"edge_mm": 4},
    "physics": {"anatomy": {}, "fibres": {}},
}
SURFACES = ["epicardium", "lv_endocardium", "rv_endocardium", "rv_septum", "base"]
LOADED = ["lv_endocardium", "rv_endocardium", "rv_septum"]
LARGEST_PART = 0.01  # of linear elements; core/README.md says what was found


def expect(holds, what):
    if not holds:
        sys.exit(f"mechanics_case: {what}")


def run(voxtet, *words):
    subprocess.run([voxtet, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def read_vtk(path, reader):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def numbers(text):
    return [float(word) for word in text.split(",")]


def rows(element, tag, convert=int):
    return np.array([[convert(word) for word in row.text.split(",")] for row in element.findall(tag)])


def volumes(points, tets):
    edges = points[tets[:, 1:]] - points[tets[:, :1]]
    return np.einsum("ij,ij->i", edges[:, 0], np.cross(edges[:, 1], edges[:, 2])) / 6


class Mesh:
    """What the .vtu of the same case has."""

    def __init__(self, path):
        grid = read_vtk(path, vtk.vtkXMLUnstructuredGridReader())
        self.points = vtk_to_numpy(grid.GetPoints().GetData())
        self.tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
        of_cell = lambda name: vtk_to_numpy(grid.GetCellData().GetArray(name))
        self.labels, self.fibres, self.sheets = of_cell("label"), of_cell("fibre"), of_cell("sheet")


class FebioCase:
    """Of a .feb: its mesh and analysis, numbers from 0."""

    def __init__(self, path):
        self.root = root = ElementTree.parse(path).getroot()
        expect([child.tag for child in root] == ["Module", "Control", "Material", "Mesh", "MeshDomains", "MeshData",
                                                 "Boundary", "Loads", "LoadData", "Output"], "FEBio: sections")
        self.points = rows(root.find("Mesh/Nodes"), "node", float)
        parts = root.findall("Mesh/Elements")
        self.count = sum(len(part) for part in parts)
        self.tets = np.zeros((self.count, len(parts[0][0].text.split(","))), dtype=int)
        self.fibres, self.sheets = np.zeros((2, self.count, 3))
        self.parts = {}
        axes = {data.get("elem_set"): data for data in root.findall("MeshData/ElementData[@type='mat_axis']")}
        for part in parts:
            at = np.array([int(element.get("id")) - 1 for element in part])
            self.parts[part.get("name")] = at
            self.tets[at] = rows(part, "elem") - 1
            data = axes[part.get("name")]
            expect([int(row.get("lid")) for row in data] == list(range(1, len(at) + 1)), "FEBio: lid of axes")
            self.fibres[at] = [numbers(row.find("a").text) for row in data]
            self.sheets[at] = [numbers(row.find("d").text) for row in data]
        self.surfaces = {surface.get("name"): np.array([[int(n) - 1 for n in face.text.split(",")] for face in surface])
                         for surface in root.findall("Mesh/Surface")}

    def expect_whole(self):
        root = self.root
        materials = [material.get("name") for material in root.findall("Material/material")]
        for domain in root.findall("MeshDomains/SolidDomain"):
            expect(domain.get("name") in self.parts and domain.get("mat") in materials, "FEBio: domain")
        curves = [curve.get("id") for curve in root.findall("LoadData/load_controller")]
        expect([load.get("surface") for load in root.findall("Loads/surface_load")] == LOADED, "FEBio: loads")
        for load in root.findall("Loads/surface_load"):
            expect(load.get("surface") in self.surfaces and load.find("pressure").get("lc") in curves, "FEBio: load")
        held = root.find("Boundary/bc").get("node_set")
        expect(held == "@surface:base" and "base" in self.surfaces, "FEBio: what is held")

    def problem(self):
        """Numbers as inflation_fenicsx.py has them."""
        material = self.root.find("Material/material")
        value = lambda path: float(material.find(path).text)
        matrix, fibre = "solid[@type='Mooney-Rivlin']/", "solid[@type='fiber-exp-pow-uncoupled']/"
        expect(value(fibre + "beta") == 2 and material.find("pressure_model").text == "NIKE3D", "FEBio: material")
        expect(material.find(fibre + "fiber").text == "1,0,0", "FEBio: fibres are the first axis")
        return {"c1_kpa": value(matrix + "c1"), "c2_kpa": value(matrix + "c2"), "a_f_kpa": value(fibre + "ksi"),
                "b_f": value(fibre + "alpha"), "bulk_kpa": value("k"),
                "pressure_kpa": float(self.root.find("Loads/surface_load/pressure").text),
                "steps": int(self.root.find("Control/time_steps").text)}


class SvCase:
    """Of an .xml for svMultiPhysics and the files that it names, numbers from 0."""

    def __init__(self, path):
        self.root = root = ElementTree.parse(path).getroot()
        mesh = root.find("Add_mesh")
        grid = read_vtk(path.parent / mesh.find("Mesh_file_path").text, vtk.vtkXMLUnstructuredGridReader())
        self.points = vtk_to_numpy(grid.GetPoints().GetData())
        self.tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
        for name, of, count in (("GlobalNodeID", grid.GetPointData(), len(self.points)),
                                ("GlobalElementID", grid.GetCellData(), len(self.tets))):
            ids = of.GetArray(name)
            expect(isinstance(ids, vtk.vtkIntArray), f"svMultiPhysics: {name} is Int32")
            expect(np.array_equal(vtk_to_numpy(ids), np.arange(1, count + 1)), f"svMultiPhysics: {name}")
        directions = [read_vtk(path.parent / file.text, vtk.vtkXMLUnstructuredGridReader()).GetCellData().GetArray("FIB_DIR")
                      for file in mesh.findall("Fiber_direction_file_path")]
        expect(all(isinstance(array, vtk.vtkDoubleArray) for array in directions), "svMultiPhysics: FIB_DIR is Float64")
        self.fibres, self.sheets = map(vtk_to_numpy, directions)
        self.surfaces, self.owners = {}, {}
        for face in mesh.findall("Add_face"):
            data = read_vtk(path.parent / face.find("Face_file_path").text, vtk.vtkXMLPolyDataReader())
            ids, owners = data.GetPointData().GetArray("GlobalNodeID"), data.GetCellData().GetArray("GlobalElementID")
            expect(isinstance(ids, vtk.vtkIntArray) and isinstance(owners, vtk.vtkIntArray), "svMultiPhysics: ids of faces")
            ids = vtk_to_numpy(ids) - 1
            expect(np.array_equal(vtk_to_numpy(data.GetPoints().GetData()), self.points[ids]), "svMultiPhysics: face points")
            corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
            self.surfaces[face.get("name")] = ids[corners]
            self.owners[face.get("name")] = vtk_to_numpy(owners) - 1
        self.folder = path.parent

    def expect_whole(self):
        bcs = {bc.get("name"): bc for bc in self.root.findall("Add_equation/Add_BC")}
        expect(list(bcs) == ["base", *LOADED] and all(name in self.surfaces for name in bcs), "svMultiPhysics: BCs")
        for name, faces in self.surfaces.items():
            of_tets = self.tets[self.owners[name]]
            expect(all(np.isin(face, tet).all() for face, tet in zip(faces, of_tets)), f"svMultiPhysics: tets at {name}")

    def problem(self):
        equation = self.root.find("Add_equation")
        value = lambda path: float(equation.find(path).text)
        expect(equation.find("Dilational_penalty_model").text == "ST91", "svMultiPhysics: penalty")
        ramp = (self.folder / equation.find("Add_BC[@name='lv_endocardium']/Temporal_values_file_path").text).read_text()
        model = "Constitutive_model/"
        return {"a": value(model + "a"), "b": value(model + "b"), "a_f_kpa": value(model + "a4f"),
                "b_f": value(model + "b4f"), "k": value(model + "k"), "bulk_kpa": value("Penalty_parameter"),
                "pressure_kpa": float(ramp.split()[-1]), "steps": 10}


def expect_same_mesh(case, mesh, what):
    expect(np.array_equal(case.points, mesh.points), f"{what}: points")
    expect(np.array_equal(case.tets, mesh.tets), f"{what}: tetrahedra")
    expect((volumes(case.points, case.tets) > 0).all(), f"{what}: orientation")
    for name in ("fibres", "sheets"):
        found = getattr(case, name)
        expect(np.abs(found - getattr(mesh, name)).max() < 1e-6, f"{what}: {name}")
    expect(np.abs(np.linalg.norm(case.fibres, axis=1) - 1).max() < 1e-6, f"{what}: unit vectors")


def outside(points, tets):
    """Outer triangles, normals outwards, each from its least corner on."""
    faces = np.vstack([tets[:, list(face)] for face in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))])
    _, first, counts = np.unique(np.sort(faces), axis=0, return_index=True, return_counts=True)
    return from_least(faces[first[counts == 1]])


def from_least(triangles):
    turned = (np.argmin(triangles, axis=1)[:, None] + np.arange(3)) % 3
    return np.take_along_axis(triangles, turned, axis=1)


def expect_surfaces(case, what):
    named = np.vstack([from_least(case.surfaces[name]) for name in SURFACES])
    expected = outside(case.points, case.tets)
    as_set = lambda triangles: {tuple(row) for row in triangles.tolist()}
    expect(len(named) == len(expected) and as_set(named) == as_set(expected), f"{what}: named surfaces are the outside")


def check_second_order(voxtet, folder, mesh):
    run(voxtet, "mesh", folder / "heart.json", "--mechanics", folder / "second.feb", "--order", 2)
    case = FebioCase(folder / "second.feb")
    case.expect_whole()
    expect(case.tets.shape[1] == 10 and np.array_equal(case.tets[:, :4], mesh.tets), "second order: corners")
    ends = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
    for column, (a, b) in enumerate(ends, 4):
        middle = (case.points[case.tets[:, a]] + case.points[case.tets[:, b]]) / 2
        off = np.linalg.norm(case.points[case.tets[:, column]] - middle, axis=1)
        length = np.linalg.norm(case.points[case.tets[:, a]] - case.points[case.tets[:, b]], axis=1)
        expect((off < 0.3 * length).all() and np.median(off) == 0, f"second order: node {column}")
    domain = case.root.find("MeshDomains/SolidDomain")
    expect(domain.get("elem_type") == "TET10G4", "second order: places of integration")


def solve(case, energy, name):
    """Displacements of the points."""
    import inflation_fenicsx

    problem = {**case.problem(), "points_mm": case.points.ravel(), "tets": case.tets, "fibres": case.fibres.ravel(),
               "loaded": np.vstack([case.surfaces[surface] for surface in LOADED]), "held": case.surfaces["base"]}
    solver = inflation_fenicsx.Problem(problem, 1, 1, energy)
    iterations, seconds = solver.solve(problem)
    off, at = inflation_fenicsx.cKDTree(case.points).query(solver.space.tabulate_dof_coordinates())
    u = np.empty_like(case.points)
    u[at] = solver.u.x.array.reshape(-1, 3)
    print(f"{name}: {iterations} iterations, {seconds:.1f} s, at most {np.linalg.norm(u, axis=1).max():.4f} mm", flush=True)
    return u


def check_solutions(febio, sv):
    try:
        import inflation_fenicsx
        import ufl
    except SystemExit:  # inflation_fenicsx has said why
        return

    def invariants(u):
        f = ufl.Identity(3) + ufl.grad(u)
        c, j = f.T * f, ufl.det(f)
        return c, j, j ** (-2 / 3) * ufl.tr(c)

    def stiffening(case, x):
        return case["a_f_kpa"] / (2 * case["b_f"]) * (ufl.exp(case["b_f"] * x**2) - 1)

    def of_febio(case, u, fibre):
        """"FEBio Feature Manual": Mooney-Rivlin, fiber-exp-pow-uncoupled; NIKE3D's U of its sources."""
        c, j, i1 = invariants(u)
        i2 = (i1**2 - j ** (-4 / 3) * ufl.tr(c * c)) / 2
        x = j ** (-2 / 3) * ufl.dot(fibre, c * fibre) - 1
        return (case["c1_kpa"] * (i1 - 3) + case["c2_kpa"] * (i2 - 3) + ufl.conditional(ufl.gt(x, 0), stiffening(case, x), 0)
                + case["bulk_kpa"] / 4 * (j**2 - 2 * ufl.ln(j) - 1))

    def of_sv(case, u, fibre):
        """HolzapfelOgden-ModifiedAnisotropy with b = 0, whose first term is then linear, and ST91."""
        c, j, i1 = invariants(u)
        x = ufl.dot(fibre, c * fibre) - 1
        return (case["a"] / 2 * (i1 - 3) + stiffening(case, x) / (1 + ufl.exp(-case["k"] * x))
                + case["bulk_kpa"] / 4 * (j**2 - 2 * ufl.ln(j) - 1))

    ours = solve(febio, inflation_fenicsx.energy_of, "voxtet's energy")
    largest = np.linalg.norm(ours, axis=1).max()
    for name, case, energy in (("FEBio", febio, of_febio), ("svMultiPhysics", sv, of_sv)):
        gap = np.linalg.norm(solve(case, energy, name) - ours, axis=1).max() / largest
        print(f"{name}: {100 * gap:.3f} % of the largest displacement off")
        expect(gap <= LARGEST_PART, f"{name}: displacements differ by {100 * gap:.2f} %")


def main():
    voxtet = sys.argv[1]
    logging.disable(logging.INFO)  # of FEniCSx' compiler of forms
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "heart.json").write_text(json.dumps(CASE))
        run(voxtet, "mesh", folder / "heart.json", "--until", "fibres", "-o", folder / "heart.vtu", "--mechanics",
            folder / "heart.feb")
        run(voxtet, "mesh", folder / "heart.json", "--mechanics", folder / "heart.xml")
        mesh, febio, sv = Mesh(folder / "heart.vtu"), FebioCase(folder / "heart.feb"), SvCase(folder / "heart.xml")
        for case, what in ((febio, "FEBio"), (sv, "svMultiPhysics")):
            expect_same_mesh(case, mesh, what)
            expect_surfaces(case, what)
            case.expect_whole()
        print(f"{len(mesh.points)} points, {len(mesh.tets)} tetrahedra")
        check_second_order(voxtet, folder, mesh)
        check_solutions(febio, sv)


if __name__ == "__main__":
    main()
