"""What voxtet writes for Abaqus, FEBio and as XDMF, read by CalculiX, meshio, h5py and Python's XML parser."""
import subprocess
import xml.etree.ElementTree as ElementTree

from cube_files import expect, expect_points, expect_positive
import h5py
import meshio
import numpy as np
from written_meshes import CELL_DATA, expect_cell_data

WORDS = {1: "LV_myocardium_1", 7: "label_7", 300: "veine_cave_sup_rieure_300", 0: "background"}
# The nodes of each face of a C3D4 outwards: those of Abaqus' and CalculiX' manuals, turned round.
OUTWARD_FACES = {"S1": (2, 1, 0), "S2": (1, 3, 0), "S3": (2, 3, 1), "S4": (0, 3, 2)}
CALCULIX_RELATIVE = 1e-6  # it prints seven digits


def from_least(triangles):
    """Each triangle from its least corner on, in the same sense."""
    first = np.argmin(triangles, axis=1)
    return np.take_along_axis(triangles, (first[:, None] + np.arange(3)) % 3, axis=1)


def expect_parts(cube, parts, what):
    """Of each part: the numbers of its tetrahedra, from 0, and their corners."""
    labels = sorted(set(cube.labels.tolist()))
    expect(list(parts) == [WORDS[label] for label in labels], f"{what}: parts {list(parts)}")
    for label, (tets, corners) in zip(labels, parts.values()):
        expect(np.array_equal(tets, np.flatnonzero(cube.labels == label)), f"{what}: tetrahedra of label {label}")
        expect(np.array_equal(corners, cube.tets[tets]), f"{what}: corners in label {label}")


def pair_faces(cube):
    """The triangles of each pair of sides by the name that it has in solvers."""
    return {f"{WORDS[behind]}__{WORDS[front]}": cube.faces[cube.pair_rank == rank]
            for rank, (behind, front) in enumerate(cube.pairs, 1)}


def expect_surfaces(cube, surfaces, what):
    wanted = pair_faces(cube)
    expect(list(surfaces) == list(wanted), f"{what}: surfaces {list(surfaces)}")
    for name, triangles in surfaces.items():
        expect(np.array_equal(from_least(triangles), from_least(wanted[name])), f"{what}: faces of {name}")


def expect_note(text, space, what):
    axes = {"ras": "right of the patient, y anterior", "lps": "left of the patient, y posterior"}[space]
    expect(f"space {space.upper()}, unit mm: x to the {axes}, z superior" in text, f"{what}: space and unit")


def inp_blocks(text):
    """The keyword lines of an Abaqus file, each with its data lines."""
    blocks = []
    for line in text.splitlines():
        if line.startswith("*") and not line.startswith("**"):
            blocks.append((line, []))
        elif not line.startswith("**"):
            blocks[-1][1].append(line.split(", "))
            expect(all(len(word) <= 20 for word in blocks[-1][1][-1]), f"Abaqus: more than 20 characters in {line}")
    return blocks


def check_abaqus(cube, folder, space):
    path = folder / f"{space}.inp"
    text = path.read_text(encoding="ascii")
    expect_note(text, space, "Abaqus")
    mesh = meshio.read(path)
    expect_points(mesh.points, cube.points, "Abaqus by meshio")
    expect({block.type for block in mesh.cells} == {"tetra"}, "Abaqus by meshio: types")
    corners = {name: block.data for name, block in zip(mesh.cell_sets, mesh.cells)}
    parts, surfaces = {}, {}
    for keyword, rows in inp_blocks(text):
        if keyword.startswith("*ELEMENT"):
            name = keyword.split("ELSET=")[1]
            parts[name] = np.array([int(row[0]) - 1 for row in rows]), corners[name]
        if keyword.startswith("*SURFACE"):
            surfaces[keyword.split("NAME=")[1].split(",")[0]] = np.array(
                [cube.tets[int(tet) - 1][list(OUTWARD_FACES[face])] for tet, face in rows])
    expect_parts(cube, parts, "Abaqus by meshio")
    expect_positive(mesh.points, np.concatenate(list(corners.values())), "Abaqus by meshio")
    expect_surfaces(cube, surfaces, "Abaqus")
    for name in CELL_DATA:
        lines = (folder / f"{space}.{name}.inp").read_text(encoding="ascii").splitlines()
        expect(lines[0].startswith("** ") and lines[1] == ", 0", f"Abaqus: first lines of {name}")
        rows = np.array([line.split(",") for line in lines[2:]], float)
        expect(np.array_equal(rows[:, 0], np.arange(len(cube.tets)) + 1), f"Abaqus: elements of {name}")
        expect_cell_data(cube, rows[:, 1], name, "Abaqus")


def run_calculix(cube, folder, space):
    """An analysis without load of the mesh: the numbers that it prints, by set or surface."""
    parts = [WORDS[label] for label in sorted(set(cube.labels.tolist()))]
    fixed = cube.tets[0][:3] + 1
    deck = [f"*INCLUDE, INPUT={space}.inp", "*MATERIAL, NAME=MATERIAL", "*ELASTIC", "1, 0.3",
            *[f"*SOLID SECTION, ELSET={part}, MATERIAL=MATERIAL" for part in parts],
            "*BOUNDARY", *[f"{node}, 1, 3" for node in fixed], "*STEP", "*STATIC"]
    for rank, name in enumerate(pair_faces(cube)):
        deck += [f"*SECTION PRINT, SURFACE={name}, NAME=SURFACE{rank}", "SOF, SOM, SOAREA"]
    for part in parts:
        deck += [f"*EL PRINT, ELSET={part}, TOTALS=ONLY", "EVOL"]
    (folder / f"{space}_deck.inp").write_text("\n".join([*deck, "*END STEP", ""]))
    done = subprocess.run(["ccx", f"{space}_deck"], cwd=folder, capture_output=True, text=True, check=False)
    expect(done.returncode == 0 and "*ERROR" not in done.stdout and "*WARNING" not in done.stdout,
           f"CalculiX complains: {done.stdout}{done.stderr}")
    numbers, rows = {}, []
    for line in (folder / f"{space}_deck.dat").read_text(encoding="utf-8").splitlines():
        if " set " in line:
            rows = numbers.setdefault(line.split(" set ")[1].split(" and ")[0], [])
        elif "E+" in line or "E-" in line:
            rows.append(np.array(line.split(), float))
    return numbers


def check_calculix(cube, folder, space):
    """Volumes of the parts; centre, mean normal and area of the surfaces."""
    numbers = run_calculix(cube, folder, space)

    def expect_near(found, wanted, what):
        scale = np.abs(wanted).max()
        expect(np.abs(found - wanted).max() <= CALCULIX_RELATIVE * scale, f"CalculiX: {what} {found}, expected {wanted}")

    p = cube.points[cube.tets]
    volumes = np.einsum("ij,ij->i", p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0])) / 6
    for label in set(cube.labels.tolist()):
        expect_near(numbers[WORDS[label].upper()][0][0], volumes[cube.labels == label].sum(), f"volume of label {label}")
    for name, faces in pair_faces(cube).items():
        p = cube.points[faces]
        vectors = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) / 2
        areas = np.linalg.norm(vectors, axis=1)
        _, centre_and_normal, _, area = numbers[name.upper()]
        expect_near(area[0], areas.sum(), f"area of {name}")
        expect_near(centre_and_normal[:3], areas @ p.mean(1) / areas.sum(), f"centre of {name}")
        expect_near(centre_and_normal[3:], vectors.sum(0) / areas.sum(), f"mean normal of {name}")


def rows_of(section):
    ids = np.array([int(row.get("id")) for row in section]) - 1
    return ids, np.array([row.text.split(",") for row in section], float)


def check_febio(cube, folder, space):
    path = folder / f"{space}.feb"
    expect_note(path.read_text(encoding="utf-8"), space, "FEBio")
    root = ElementTree.parse(path).getroot()
    expect((root.tag, root.get("version")) == ("febio_spec", "4.0"), "FEBio: version")
    expect([section.tag for section in root] == ["Module", "Material", "Mesh", "MeshDomains", "MeshData"],
           "FEBio: sections")
    expect(root.find("Module/units").text == "mm-kg-s", "FEBio: units")
    mesh = root.find("Mesh")
    ids, points = rows_of(mesh.find("Nodes"))
    expect(np.array_equal(ids, np.arange(len(cube.points))), "FEBio: node ids")
    expect_points(points, cube.points, "FEBio", 0)
    parts = {section.get("name"): rows_of(section) for section in mesh.iter("Elements")}
    expect({section.get("type") for section in mesh.iter("Elements")} == {"tet4"}, "FEBio: type of elements")
    expect_parts(cube, {name: (ids, corners - 1) for name, (ids, corners) in parts.items()}, "FEBio")
    surfaces = {section.get("name"): rows_of(section) for section in mesh.iter("Surface")}
    expect({row.tag for section in mesh.iter("Surface") for row in section} == {"tri3"}, "FEBio: type of faces")
    expect(all(np.array_equal(ids, np.arange(len(ids))) for ids, _ in surfaces.values()), "FEBio: ids of faces")
    expect_surfaces(cube, {name: (faces - 1).astype(int) for name, (_, faces) in surfaces.items()}, "FEBio")
    materials = [material.get("name") for material in root.find("Material")]
    domains = {domain.get("name"): domain.get("mat") for domain in root.iter("SolidDomain")}
    expect(list(domains) == list(parts) and list(domains.values()) == materials, f"FEBio: domains {domains}")
    for name in CELL_DATA:
        values = np.zeros(len(cube.tets))
        for section in root.findall(f"MeshData/ElementData[@name='{name}']"):
            ids, _ = parts[section.get("elem_set")]
            expect([int(row.get("lid")) for row in section] == list(range(1, len(ids) + 1)), f"FEBio: lids of {name}")
            values[ids] = [float(row.text) for row in section]
        expect_cell_data(cube, values, name, "FEBio")


def check_xdmf(cube, folder, space):
    path = folder / f"{space}.xdmf"
    expect_note(path.read_text(encoding="utf-8"), space, "XDMF")
    mesh = meshio.read(path)
    expect(mesh.points.dtype == np.float64, "XDMF by meshio: type of points")
    expect_points(mesh.points, cube.points, "XDMF by meshio", 0)
    expect(np.array_equal(mesh.cells_dict["tetra"], cube.tets), "XDMF by meshio: tetrahedra")
    expect_positive(mesh.points, mesh.cells_dict["tetra"], "XDMF by meshio")
    expect(np.array_equal(mesh.cell_data["label"][0], cube.labels), "XDMF by meshio: labels")
    for name in CELL_DATA:
        expect_cell_data(cube, mesh.cell_data[name][0], name, "XDMF by meshio")
    with h5py.File(folder / f"{space}.h5", "r") as file:
        types = {name: array.dtype.str for name, array in file.items()}
        expect(types == {"points": "<f8", "tets": "<i4", "label": "<i4", **{name: "<f4" for name in CELL_DATA}},
               f"HDF5 by h5py: arrays {types}")
    many = meshio.read(folder / "many.xdmf").cell_data
    expect(list(many) == ["label", *[f"value_{i}" for i in range(21)]], f"XDMF by meshio: {list(many)}")
    expect(all((many[f"value_{i}"][0] == i).all() for i in range(21)), "XDMF by meshio: many cell data")


CHECKS = (check_abaqus, check_calculix, check_febio, check_xdmf)
