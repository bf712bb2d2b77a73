"""Second-order meshes that voxtet makes, judged from their coordinates alone.

Sample run: second_order.py build/native/voxtet [FOLDER]

A ball and a heart of the phantoms, or the cases of tests/sweep/table_cases.h from a folder of volumes: as VTU by VTK and as
MSH by Gmsh; one node for each edge; Jacobian determinants positive, at samples here and everywhere by Gmsh, which finds no
less than voxtet said; faces no farther from the label surface than those of first order, as voxtet says. The ball's volume
is nearer to the truth than that of the first-order mesh. Exit code 77: something that this needs is absent.
"""
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from cube_files import expect, vtk_grid
import numpy as np
import vtk
from written_second_order import least_scaled_jacobian

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
RANDOM_PLACES = 20


def determinants(points, tets, place):
    """Of d x / d(barycentric 1, 2, 3) at one place of each tetrahedron of ten nodes."""
    slopes = np.zeros((10, 4))
    slopes[range(4), range(4)] = 4 * place - 1
    for e, (a, b) in enumerate(EDGES):
        slopes[4 + e, a], slopes[4 + e, b] = 4 * place[b], 4 * place[a]
    return np.linalg.det(np.einsum("nk,tnd->tkd", slopes[:, 1:] - slopes[:, :1], points[tets]))


def volume(points, tets):
    """By a rule that is exact for cubics, as determinants are."""
    total = -0.8 * determinants(points, tets, np.full(4, 0.25)).sum()
    for i in range(4):
        total += 0.45 * determinants(points, tets, np.where(np.arange(4) == i, 1 / 2, 1 / 6)).sum()
    return total / 6


def least_share(points, tets):
    """The least determinant at nodes, middles and random places over that of the straight tetrahedron."""
    corners = points[tets[:, :4]]
    edges = corners[:, 1:] - corners[:, :1]
    straight = np.linalg.det(edges.transpose(0, 2, 1))
    places = [*np.eye(4), *[(np.eye(4)[a] + np.eye(4)[b]) / 2 for a, b in EDGES], np.full(4, 0.25),
              *np.random.default_rng(7).dirichlet(np.ones(4), RANDOM_PLACES)]
    return min((determinants(points, tets, place) / straight).min() for place in places)


def check(voxtet, folder, name, arguments):
    said = subprocess.run([voxtet, "mesh", *arguments, "--order", "2", "-o", folder / f"{name}.vtu"], check=True,
                          capture_output=True, text=True).stderr
    _, points, cells, types = vtk_grid(folder / f"{name}.vtu")
    expect((types == vtk.VTK_QUADRATIC_TETRA).all(), f"{name}: cell types")
    tets = cells.reshape(-1, 10)
    ends = np.concatenate([np.sort(tets[:, edge], axis=1) for edge in EDGES])
    nodes = np.concatenate([tets[:, 4 + e] for e in range(6)])
    pairs = np.unique(np.column_stack([ends, nodes]), axis=0)
    expect(len(pairs) == len(np.unique(ends, axis=0)) == len(np.unique(nodes)), f"{name}: one node for each edge")
    expect(tets[:, :4].max() + 1 + len(pairs) == len(points), f"{name}: number of points")
    off = np.linalg.norm(points[pairs[:, 2]] - points[pairs[:, :2]].mean(1), axis=1)
    expect((off > 0).any(), f"{name}: no edge is curved")
    share = least_share(points, tets)
    expect(share > 0, f"{name}: Jacobian determinants down to {share} of the straight one")
    note = said.split("second order, ")[1].splitlines()[0]
    numbers = [float(number) for number in re.findall(r"\d+\.\d+", note)]
    mean, largest, first_mean, first_largest, said_least = numbers
    expect(mean <= first_mean and largest <= first_largest, f"{name}: farther from the label surface: {note}")
    subprocess.run([voxtet, "mesh", *arguments, "--order", "2", "-o", folder / f"{name}.msh"], check=True,
                   capture_output=True)
    by_gmsh = least_scaled_jacobian(folder / f"{name}.msh")
    expect(by_gmsh > 0 and by_gmsh > said_least - 1e-3, f"{name}: scaled Jacobian by gmsh {by_gmsh}, said {said_least}")
    print(f"{name}: {len(tets)} tetrahedra, least sampled determinant {share:.3f} of the straight one, "
          f"least scaled Jacobian by Gmsh {by_gmsh:.3f}; {note}", flush=True)
    return points, tets


def table_cases(data):
    for file, labels, edge in (("biv_mean_1mm", "1,2", 2), ("biv_ed_scar_1mm", "1,2,5,6", 2),
                               ("biv_es_oblique_sax", "1,2", 2.8125), ("ct_aorta_dissection_1.5mm", "1,2", 3)):
        case = [data / f"{file}.nii.gz", "--labels", labels, "--edge-mm", str(edge)]
        yield f"{file}_conforming", case
        yield f"{file}_merged", [*case, "--merge", labels]
    yield "graded", [data / "biv_ed_scar_1mm.nii.gz", "--labels", "1,2,5,6", "--edge-mm", "2", "--edge-label", "5=0.8",
                     "--edge-label", "6=0.8"]


def main():
    voxtet = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if len(sys.argv) > 2:
            for name, arguments in table_cases(pathlib.Path(sys.argv[2])):
                check(voxtet, folder, name, arguments)
            return
        for kind, spacing in (("sphere", 0.6), ("biventricle", 1.2)):
            subprocess.run([voxtet, "phantom", kind, "--set", f"spacing_mm=[{spacing},{spacing},{spacing}]", "-o",
                            folder / f"{kind}.nii.gz"], check=True, stdout=subprocess.DEVNULL)
        points, tets = check(voxtet, folder, "sphere", [folder / "sphere.nii.gz", "--edge-mm", "6"])
        radius, truth = 20, 4 / 3 * math.pi * 20**3
        corners = points[tets[:, :4]]
        first = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
        second = volume(points, tets)
        expect(abs(second - truth) < abs(first - truth) / 2, f"sphere of radius {radius}: {first}, {second}, truth {truth}")
        check(voxtet, folder, "biventricle", [folder / "biventricle.nii.gz", "--edge-mm", "3"])


if __name__ == "__main__":
    main()
