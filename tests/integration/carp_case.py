#!/usr/bin/python3
"""A case for openCARP, run here by another program from its files alone.

  carp_case.py VOXTET

A small heart with fibres and scar is simulated and written for openCARP. Then carp_files.py reads the files by the
description of their formats, and

1. mesh, directions and activation are those of the .vtu, as VTK reads it;
2. the conductivities of the .par give the speeds of the recipe, by the formula of the plane wave;
3. the frames of the .igb cross the threshold when the points are activated;
4. a solver of the monodomain model that is written below, with the numbers of the .par, .lon, .vtx and .elem, finds the
   activation of .expected_ms.dat;
5. where dolfinx is installed, it reads the .xdmf with the labels and the named surfaces as markers.

Exit 0 if all agree, 1 if not, 77 (skipped) without numpy, scipy or VTK.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import vtk
    from scipy.sparse import coo_matrix
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import carp_files

SPEEDS = [(0.6, 0.3), (0.24, 0.12)]  # mm/ms
CENTRE, RADIUS = np.array([0, 0, -20]), 8  # mm
CASE = {
    "source": {"phantom": {"kind": "biventricle", "scale": 0.5, "scar": True, "roughness_mm": 0}},
    "labels": [1, 2, 5, 6],
    "sizing": {"edge_mm": 3},
    "physics": {
        "anatomy": {},
        "fibres": {},
        "tissue": {
            "kinds": [
                {"labels": [1, 2], "along_mm_per_ms": SPEEDS[0][0], "across_mm_per_ms": SPEEDS[0][1]},
                {"labels": [6], "along_mm_per_ms": SPEEDS[1][0], "across_mm_per_ms": SPEEDS[1][1], "cell": "mms"},
            ]
        },
        "stimuli": [{"name": "apex", "centre_mm": CENTRE.tolist(), "radius_mm": RADIUS, "start_ms": 2}],
        # Lumped and explicit, as the solver below.
        "monodomain": {"integration": "explicit", "end_ms": 200, "step_ms": 0.05, "frame_ms": 5},
    },
}
SUBSTEP_MS = 0.02


def run(voxtet, *words):
    subprocess.run([voxtet, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def read_vtu(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


class Case:
    """The files of a case."""

    def __init__(self, folder, name):
        self.par = carp_files.read_par(folder / f"{name}.par")
        assert self.par["meshname"] == name
        self.points = np.array(carp_files.read_pts(folder / f"{name}.pts")) / 1000  # mm
        tets, regions = carp_files.read_elem(folder / f"{name}.elem")
        self.tets, self.regions = np.array(tets), np.array(regions)
        self.directions = np.array(carp_files.read_lon(folder / f"{name}.lon"))
        self.activation = np.array(carp_files.read_dat(folder / f"{name}.activation_ms.dat"))
        self.expected = np.array(carp_files.read_dat(folder / f"{name}.expected_ms.dat"))
        self.electrodes = [
            carp_files.read_vtx(folder / self.par[f"stim[{i}].elec.vtx_file"]) for i in range(int(self.par["num_stim"]))
        ]
        conducting = carp_files.regions_of(self.par, "phys_region[0]")
        self.conducts = np.isin(self.regions, conducting)
        self.domain = np.unique(self.tets[self.conducts])  # points of the tissue, in the order of .pts

    def cell(self, i):
        return {key: float(value) for key, value in
                (word.split("=") for word in self.par[f"imp_region[{i}].im_param"].split(","))}


def check_against_vtu(case, grid):
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert np.abs(points - case.points).max() < 1e-9
    assert np.array_equal(vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4), case.tets)
    assert np.array_equal(vtk_to_numpy(grid.GetCellData().GetArray("label")), case.regions)
    for i, name in enumerate(("fibre", "sheet")):
        wanted = vtk_to_numpy(grid.GetCellData().GetArray(name))
        assert np.array_equal(case.directions[:, 3 * i : 3 * i + 3].astype(np.float32), wanted), name
    found = vtk_to_numpy(grid.GetPointData().GetArray("activation_ms"))
    assert np.array_equal(np.where(np.isnan(found), -1, found), case.activation.astype(np.float32))
    # The results of openCARP have the points of the tissue alone.
    assert np.array_equal(case.activation[case.domain], case.expected)
    assert set(case.regions) == {1, 2, 5, 6} and not case.conducts[case.regions == 5].any()
    lengths = np.linalg.norm(case.directions[case.conducts][:, :3], axis=1)
    assert np.abs(lengths - 1).max() < 1e-6


def diffusivities(case, i):
    """mm^2/ms: D = g / (chi Cm), with g in S/m, chi in 1/um and Cm = 1 uF/cm^2."""
    assert case.par["bidm_eqv_mono"] == 0  # the conductivities are the monodomain's
    farad_per_m3 = case.par[f"imp_region[{i}].cellSurfVolRatio"] * 1e6 * 0.01
    m2_per_s_in_mm2_per_ms = 1e3
    return [case.par[f"gregion[{i}].{key}"] / farad_per_m3 * m2_per_s_in_mm2_per_ms for key in ("g_il", "g_it", "g_in")]


def plane_wave_speed(cell, d):
    """Of Mitchell and Schaeffer's cell at rest: a cubic reaction k v (v - a) (b - v) has sqrt(d k / 2) (b - 2 a)."""
    if cell["a_crit"] > 0:
        a, b = cell["a_crit"], 1
    else:
        root = math.sqrt(1 - 4 * cell["tau_in"] / cell["tau_out"])
        a, b = (1 - root) / 2, (1 + root) / 2
    return math.sqrt(d / cell["tau_in"] / 2) * (b - 2 * a)


def check_parameters(case):
    par = case.par
    for i, (along, across) in enumerate(SPEEDS):
        assert carp_files.regions_of(par, f"gregion[{i}]") == carp_files.regions_of(par, f"imp_region[{i}]")
        found = [plane_wave_speed(case.cell(i), d) for d in diffusivities(case, i)]
        assert np.allclose(found, [along, across, across], rtol=1e-9), found
        assert par[f"imp_region[{i}].im"] == "MitchellSchaeffer"
    assert [case.cell(i)["a_crit"] > 0 for i in range(2)] == [False, True]
    (domain, electrode), = case.electrodes
    assert domain == "intra" and set(electrode) <= set(case.domain)
    inside = case.domain[np.linalg.norm(case.points[case.domain] - CENTRE, axis=1) <= RADIUS]
    assert np.array_equal(electrode, inside)
    assert par["lats[0].threshold"] == -30 and par["stim[0].pulse.strength"] == 50


def check_frames(case, path):
    header, frames = carp_files.read_igb(path)
    assert int(header["x"]) == len(case.points) and header["unites"] == "mV" and header["unites_t"] == "ms"
    interval = float(header["inc_t"])
    assert interval == case.par["spacedt"] == 5 and (len(frames) - 1) * interval == case.par["tend"]
    voltage = np.array(frames)
    rest = np.setdiff1d(np.arange(len(case.points)), case.domain)
    assert (voltage[:, rest] == -80).all() and (voltage[0] == -80).all()
    active = np.flatnonzero(case.activation >= 0)
    after = np.ceil(case.activation[active] / interval).astype(int)
    assert (voltage[after, active] >= -30.001).all() and (voltage[after - 1, active] < -30).all()


def stiffness_and_mass(case):
    """Linear elements on the tissue: K in mm^3/ms, and the lumped mass, mm^3."""
    number = np.full(len(case.points), -1)
    number[case.domain] = np.arange(len(case.domain))
    tets = case.tets[case.conducts]
    p = case.points[tets]
    edges = p[:, 1:] - p[:, :1]
    volumes = np.linalg.det(edges) / 6
    assert (volumes > 0).all()
    inner = np.linalg.inv(edges).transpose(0, 2, 1)  # gradients of the corners 1 to 3
    gradients = np.concatenate([-inner.sum(1, keepdims=True), inner], axis=1)
    tensors = np.zeros((len(tets), 3, 3))
    for i in range(int(case.par["num_gregions"])):
        along, across, normal = diffusivities(case, i)
        assert across == normal
        mine = np.isin(case.regions[case.conducts], carp_files.regions_of(case.par, f"gregion[{i}]"))
        f = case.directions[case.conducts][mine, :3]
        tensors[mine] = across * np.eye(3) + (along - across) * f[:, :, None] * f[:, None, :]
    local = np.einsum("t,tai,tij,tbj->tab", volumes, gradients, tensors, gradients)
    corners = number[tets]
    rows, columns = np.repeat(corners, 4, axis=1).ravel(), np.tile(corners, (1, 4)).ravel()
    shape = (len(case.domain),) * 2
    mass = np.bincount(corners.ravel(), np.repeat(volumes / 4, 4), len(case.domain))
    return coo_matrix((local.ravel(), (rows, columns)), shape).tocsr(), mass, corners, volumes


def cell_arrays(case, corners, volumes):
    """Parameters of the cells of each point: of the region with most volume around it."""
    shares = []
    for i in range(int(case.par["num_imp_regions"])):
        mine = np.isin(case.regions[case.conducts], carp_files.regions_of(case.par, f"imp_region[{i}]"))
        shares.append(np.bincount(corners.ravel(), np.repeat(volumes * mine, 4), len(case.domain)))
    kind = np.argmax(shares, axis=0)
    cells = [case.cell(i) for i in range(len(shares))]
    return {key: np.array([cell[key] for cell in cells])[kind] for key in cells[0]}


def solve(case):
    """First activations, ms; -1 where there is none."""
    stiffness, mass, corners, volumes = stiffness_and_mass(case)
    c = cell_arrays(case, corners, volumes)
    step, par = case.par["dt"] / 1000, case.par
    substeps = math.ceil(step / SUBSTEP_MS - 1e-9)
    small = step / substeps
    modified = c["a_crit"] > 0
    rest, peak = case.cell(0)["V_min"], case.cell(0)["V_max"]
    threshold = (par["lats[0].threshold"] - rest) / (peak - rest)
    electrode = np.isin(case.domain, case.electrodes[0][1])
    start, duration = par["stim[0].ptcl.start"], par["stim[0].ptcl.duration"]
    v, w = np.zeros(len(mass)), np.ones(len(mass))
    found = np.full(len(mass), -1.0)
    for n in range(round(par["tend"] / step)):  # reaction and diffusion take turns
        flows = start - 1e-9 < n * step < start + duration - 1e-9
        current = np.where(electrode & flows, par["stim[0].pulse.strength"], 0) / (peak - rest)  # 1 uA/cm^2 is 1 mV/ms
        before = v
        for _ in range(substeps):
            inward = w * v * (v - c["a_crit"]) * (1 - v) / c["tau_in"]
            outward = np.where(modified, 1 - w, 1) * v / c["tau_out"]
            w = np.where(v < c["V_gate"], 1 - (1 - w) * np.exp(-small / c["tau_open"]), w * np.exp(-small / c["tau_close"]))
            v = v + small * (inward - outward + current)
        v = v - step * (stiffness @ v) / mass
        crosses = (found < 0) & (before < threshold) & (v >= threshold)
        found[crosses] = step * (n + (threshold - before[crosses]) / (v - before)[crosses])
    return found


def check_solution(case):
    found = solve(case)
    both = (found >= 0) & (case.expected >= 0)
    assert np.array_equal(found >= 0, case.expected >= 0) and both.sum() > 0.9 * len(found), both.sum()
    difference = np.abs(found - case.expected)[both]
    print(f"{both.sum()} of {len(found)} points activated up to {case.expected.max():.1f} ms; "
          f"another solver differs by {difference.mean():.5f} ms in the mean, {difference.max():.5f} at most")
    assert difference.max() < 0.01


def check_dolfinx(case, folder):
    """Labels and surfaces as markers of FEniCSx."""
    try:
        from dolfinx.io import XDMFFile
        from mpi4py import MPI
    except ImportError as error:
        print(f"without FEniCSx: {error}")
        return
    with XDMFFile(MPI.COMM_SELF, str(folder / "heart.xdmf"), "r") as file:
        mesh = file.read_mesh(name="mesh")
        labels = file.read_meshtags(mesh, name="mesh")
    assert np.array_equal(np.bincount(labels.values), np.bincount(case.regions))
    mesh.topology.create_connectivity(2, 3)
    with XDMFFile(MPI.COMM_SELF, str(folder / "heart.facets.xdmf"), "r") as file:
        surfaces = file.read_meshtags(mesh, name="facets")
    counts = [int(path.read_text().split()[0]) for path in sorted(folder.glob("heart.*.surf"))]
    # The tags of named surfaces stand behind those of the interfaces.
    assert sorted(np.bincount(surfaces.values)[-len(counts):]) == sorted(counts), counts
    print(f"FEniCSx reads {len(labels.values)} labels and {len(surfaces.values)} facets of {len(counts)} surfaces")


def main():
    voxtet = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "heart.json").write_text(json.dumps(CASE))
        run(voxtet, "simulate", folder / "heart.json", "-o", folder / "heart.carp", "--frames", folder / "vm.igb")
        for ending in ("vtu", "xdmf"):
            run(voxtet, "simulate", folder / "heart.json", "-o", folder / f"heart.{ending}")
        case = Case(folder, "heart")
        check_against_vtu(case, read_vtu(folder / "heart.vtu"))
        check_parameters(case)
        check_frames(case, folder / "vm.igb")
        check_solution(case)
        check_dolfinx(case, folder)
        # And back: openCARP's results in voxtet's own files.
        run(voxtet, "convert", folder / "heart.elem", folder / "back.vtu", "--values", folder / "heart.activation_ms.dat",
            "--values", folder / "vm.igb")
        back = read_vtu(folder / "back.vtu")
        assert np.array_equal(vtk_to_numpy(back.GetCellData().GetArray("fibre")).ravel(),
                              case.directions[:, :3].astype(np.float32).ravel())
        voltage = np.array(carp_files.read_igb(folder / "vm.igb")[1][-1])
        assert np.allclose(vtk_to_numpy(back.GetPointData().GetArray("vm")), voltage)
        wanted = np.where(case.activation == -1, np.nan, case.activation).astype(np.float32)
        assert np.array_equal(vtk_to_numpy(back.GetPointData().GetArray("activation_ms")), wanted, equal_nan=True)


if __name__ == "__main__":
    main()
