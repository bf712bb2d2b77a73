#!/usr/bin/python3
"""The monodomain model by voxtet and by FEniCSx on the same mesh: monodomain_fenicsx.py [--voxtet PROGRAM] [CASE ...].

Cases: slab, a generated plate; heart, biv_ed_scar_1mm.nii.gz of $VOXTET_DATA. voxtet meshes, simulates and writes XDMF;
FEniCSx reads the mesh from it, assembles its own matrices and takes the same steps: reaction in substeps, then
diffusion, explicit with lumped mass or by backward Euler with half-lumped mass (PETSc: conjugate gradients, Jacobi).
The reaction is numpy's. `--bricks` prints FEniCSx's times in the slab of verify_physics's checks instead. Each runs in one process with one thread. Prints how far activation times differ, in ms, and
how many seconds the steps took: of voxtet, the whole stage, which makes its matrices too. Fails where the root mean
square of the differences is above 0.5 ms.

FEniCSx is Debian's: apt-get install python3-dolfinx (0.5.2 in Debian 12), for /usr/bin/python3; also python3-h5py.
"""
import argparse
import itertools
import json
import logging
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

for library in ("OMP", "OPENBLAS"):  # before numpy is loaded
    os.environ[f"{library}_NUM_THREADS"] = "1"

import h5py
import numpy as np
import ufl
from dolfinx import fem, io, mesh
from mpi4py import MPI
from petsc4py import PETSc

ROOT = pathlib.Path(__file__).resolve().parents[3]
LARGEST_RMS_MS = 0.5
TAU_IN, TAU_OUT, TAU_OPEN, TAU_CLOSE, GATE = 0.3, 6.0, 120.0, 150.0, 0.13  # Mitchell and Schaeffer 2003, ms
LONGEST_SUBSTEP_MS = 0.02
STIMULUS_MS, STIMULUS_PER_MS = 2.0, 0.5

# Speeds in mm/ms by label; other labels do not conduct.
CASES = {
    "slab": {
        "source": {"phantom": {"kind": "slab", "radius_mm": 12, "thickness_mm": 5, "spacing_mm": [0.5, 0.5, 0.5]}},
        "labels": [1],
        "edge_mm": 1.0,
        "speeds": {1: 0.5},
        "stimulus": ([12, 12, 0], 4),
    },
    "heart": {
        "source": {"file": {"name": "biv_ed_scar_1mm.nii.gz"}},
        "labels": [1, 2, 5, 6],
        "edge_mm": 3.0,
        "speeds": {1: 0.5, 2: 0.5, 6: 0.25},
        "stimulus": ([-40, -5, -35], 8),
    },
}


def recipe_of(case, integration, step_ms, end_ms):
    kinds = [{"labels": [label], "along_mm_per_ms": s, "across_mm_per_ms": s} for label, s in case["speeds"].items()]
    centre, radius = case["stimulus"]
    return {
        "source": case["source"],
        "labels": case["labels"],
        "sizing": {"edge_mm": case["edge_mm"]},
        "physics": {
            "tissue": {"kinds": kinds},
            "stimuli": [{"shape": "sphere", "centre_mm": centre, "radius_mm": radius}],
            "monodomain": {"integration": integration, "step_ms": step_ms, "end_ms": end_ms, "frame_ms": end_ms},
        },
    }


def run_voxtet(program, recipe, folder):
    """Points, tetrahedra, labels, activation times, and the seconds of the simulation."""
    if "file" in recipe["source"]:
        data = pathlib.Path(os.environ.get("VOXTET_DATA", ROOT.parent / "shared" / "data"))
        name = recipe["source"]["file"]["name"]
        (folder / name).symlink_to((data / name).resolve())
    (folder / "case.json").write_text(json.dumps(recipe))
    files = ["-o", folder / "mesh.xdmf", "--report", folder / "report.json", "--space", "ras", "--threads", "1"]
    subprocess.run([program, "simulate", folder / "case.json", *files], check=True, stdout=subprocess.DEVNULL)
    with io.XDMFFile(MPI.COMM_SELF, folder / "mesh.xdmf", "r") as file:
        points, tets = file.read_geometry_data("mesh"), file.read_topology_data("mesh")
    with h5py.File(folder / "mesh.h5") as file:
        labels, times = file["label"][()], file["activation_ms"][()]
    stages = json.loads((folder / "report.json").read_text())["stages"]
    return points, tets, labels, times, next(s["seconds"] for s in stages if s["name"] == "monodomain")


def diffusivity_of(speed):
    """At which a plane wave in rested tissue has this speed (mm/ms): the front of the cubic reaction."""
    root = math.sqrt(1 - 4 * TAU_IN / TAU_OUT)
    return (speed / (math.sqrt(1 / (2 * TAU_IN)) * ((1 + root) / 2 - (1 - root)))) ** 2


class Matrices:
    """Of the conducting part: stiffness K, consistent mass M, and lumped mass. `nodes`: of each row its point."""

    def __init__(self, points, tets, labels, speeds, across=1):
        """`across`: of the diffusivity across the x axis over that along it."""
        scale = ufl.as_matrix(np.diag([1, across, across]).tolist())
        conducts = np.isin(labels, list(speeds))
        used, cells = np.unique(tets[conducts], return_inverse=True)
        element = ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), 1)
        domain = mesh.create_mesh(MPI.COMM_SELF, cells.reshape(-1, 4).astype(np.int64), points[used], ufl.Mesh(element))
        space = fem.FunctionSpace(domain, ("Lagrange", 1))
        diffusivity = fem.Function(fem.FunctionSpace(domain, ("DG", 0)))
        by_label = {label: diffusivity_of(speed) for label, speed in speeds.items()}
        of_tets = np.array([by_label[label] for label in labels[conducts]])
        diffusivity.x.array[:] = of_tets[domain.topology.original_cell_index]
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        self.stiffness = assembled(ufl.inner(scale * diffusivity * ufl.grad(u), ufl.grad(v)) * ufl.dx)
        self.mass = assembled(u * v * ufl.dx)
        corners = ufl.dx(metadata={"quadrature_rule": "vertex", "quadrature_degree": 1})
        self.lumped = assembled(u * v * corners).getDiagonal()
        at = np.empty(len(used), dtype=np.int64)
        for cell in range(domain.topology.index_map(3).size_local):
            at[space.dofmap.cell_dofs(cell)] = domain.geometry.dofmap.links(cell)
        self.nodes = used[np.asarray(domain.geometry.input_global_indices)[at]]


def assembled(form):
    matrix = fem.petsc.assemble_matrix(fem.form(form))
    matrix.assemble()
    return matrix


class Diffusion:
    """One step of diffusion, in place."""

    def __init__(self, matrices, integration, step_ms):
        self.stiffness, self.step_ms = matrices.stiffness, step_ms
        self.flow, self.change = matrices.stiffness.createVecs()
        self.per_mass = -step_ms / matrices.lumped.array
        self.solver = None
        if integration == "explicit":
            return
        system = matrices.mass.copy()
        system.scale(0.5)
        system.setDiagonal(system.getDiagonal() + 0.5 * matrices.lumped)
        system.axpy(step_ms, matrices.stiffness, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        self.solver = PETSc.KSP().create(MPI.COMM_SELF)
        self.solver.setOperators(system)
        self.solver.setType("cg")
        self.solver.getPC().setType("jacobi")
        self.solver.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
        self.solver.setInitialGuessNonzero(True)
        self.solver.setTolerances(rtol=1e-6, max_it=1000)

    def step(self, v):
        self.stiffness.mult(v, self.flow)
        if self.solver is None:
            v.array[:] += self.per_mass * self.flow.array
            return
        self.flow.scale(-self.step_ms)
        self.solver.solve(self.flow, self.change)
        if self.solver.getConvergedReason() < 0:
            sys.exit(f"PETSc: the solver did not converge: reason {self.solver.getConvergedReason()}")
        v.axpy(1, self.change)


def react(v, w, current, step_ms):
    substeps = math.ceil(step_ms / LONGEST_SUBSTEP_MS * (1 - 1e-9))
    dt = step_ms / substeps
    opening, closing = math.exp(-dt / TAU_OPEN), math.exp(-dt / TAU_CLOSE)
    for _ in range(substeps):
        change = w * v * v * (1 - v) / TAU_IN - v / TAU_OUT + current
        w[:] = np.where(v < GATE, 1 - (1 - w) * opening, w * closing)
        v += dt * change


def run_fenicsx(matrices, stimulated, integration, step_ms, end_ms):
    """Activation times of the rows, and the seconds of all steps and of their reactions."""
    diffusion = Diffusion(matrices, integration, step_ms)
    v = matrices.stiffness.createVecRight()
    w, times = np.ones(v.getSize()), np.full(v.getSize(), np.nan)
    reacting = 0.0
    begin = time.perf_counter()
    for step in range(round(end_ms / step_ms)):
        before = v.array.copy()
        started = time.perf_counter()
        flows = (step + 0.5) * step_ms < STIMULUS_MS
        react(v.array, w, STIMULUS_PER_MS * stimulated if flows else 0.0, step_ms)
        reacting += time.perf_counter() - started
        diffusion.step(v)
        after = v.array
        crossed = np.flatnonzero((before < 0.5) & (after >= 0.5) & np.isnan(times))
        share = (0.5 - before[crossed]) / (after[crossed] - before[crossed])
        times[crossed] = step_ms * (step + share)
    return times, time.perf_counter() - begin, reacting


def compare(program, name, integration, step_ms, end_ms):
    """Prints a row; whether the two agree."""
    case = CASES[name]
    with tempfile.TemporaryDirectory() as folder:
        recipe = recipe_of(case, integration, step_ms, end_ms)
        points, tets, labels, ours, our_seconds = run_voxtet(program, recipe, pathlib.Path(folder))
    matrices = Matrices(points, tets, labels, case["speeds"])
    ours = ours[matrices.nodes]
    centre, radius = case["stimulus"]
    stimulated = np.linalg.norm(points[matrices.nodes] - centre, axis=1) <= radius
    theirs, their_seconds, reacting = run_fenicsx(matrices, stimulated, integration, step_ms, end_ms)
    both = np.isfinite(ours) & np.isfinite(theirs)
    alone = np.count_nonzero(np.isfinite(ours) != np.isfinite(theirs))
    gap = np.abs(ours - theirs)[both]
    rms = math.sqrt(np.mean(gap**2))
    conducting = np.isin(labels, list(case["speeds"])).sum()
    print(f"{name:6} {integration:14} {conducting:7} {len(ours):7} {both.sum():7} {alone:6}"
          f" {theirs[both].max():8.1f} {rms:9.1e} {gap.max():9.1e} {our_seconds:8.2f} {their_seconds:8.2f}"
          f" {reacting:8.2f} {their_seconds / our_seconds:6.2f}", flush=True)
    return alone == 0 and rms <= LARGEST_RMS_MS


def print_bricks():
    """Activation in the slab of Niederer et al. (2011) of bricks of 0.5 mm, each cut into six around its diagonal."""
    size, edge = (40, 14, 6), 0.5
    grid = np.indices(tuple(n + 1 for n in reversed(size)))[::-1].reshape(3, -1).T
    at = np.array([1, size[0] + 1, (size[0] + 1) * (size[1] + 1)])
    bricks = grid[(grid < size).all(axis=1)] @ at
    tets = np.vstack([np.column_stack([bricks, bricks + at[a], bricks + at[a] + at[b], bricks + at.sum()])
                      for a, b, _ in itertools.permutations(range(3))])
    along = 0.0953 / diffusivity_of(1)
    matrices = Matrices(edge * grid, tets, np.ones(len(tets)), {1: math.sqrt(along)}, 0.012576 / 0.0953)
    points = edge * grid[matrices.nodes]
    stimulated = (points <= 1.5).all(axis=1).astype(float)
    times, _, _ = run_fenicsx(matrices, stimulated, "semi_implicit", 0.05, 110)
    for corner in ((20, 0, 0), (0, 7, 0), (20, 7, 3)):
        print(corner, f"{times[(points == corner).all(axis=1)][0]:.4f} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--voxtet", default=ROOT / "build" / "native" / "voxtet", help="the command line")
    parser.add_argument("--step-ms", type=float, default=0.05)
    parser.add_argument("--end-ms", type=float, default=350)
    parser.add_argument("--bricks", action="store_true")
    parser.add_argument("cases", nargs="*", help=f"of {', '.join(CASES)}; all without")
    wanted = parser.parse_args()
    logging.disable(logging.INFO)  # of the compiler of forms
    if wanted.bricks:
        return print_bricks()
    print("case   integration       tets  points reached  alone  last ms    rms ms    max ms   voxtet  fenicsx  "
          "reacts  ratio", flush=True)
    agree = [compare(wanted.voxtet, name, integration, wanted.step_ms, wanted.end_ms)
             for name in wanted.cases or CASES for integration in ("explicit", "semi_implicit")]
    sys.exit(not all(agree))


if __name__ == "__main__":
    main()
