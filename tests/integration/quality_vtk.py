#!/usr/bin/python3
"""Our measures of tetrahedra against VTK's (Verdict) and against NumPy.

  quality_vtk.py DUMP_TET_MEASURES

Random tetrahedra of every shape, from well-shaped to flat within 1e-3, small and large, far from the origin and
near. Dihedral angles are compared with NumPy alone: VTK 9.1's MinAngle does not look at all six edges and misses the
smallest angle of a quarter of these tetrahedra. Exit 0 if all agree, 1 if not, 77 (skipped) without VTK or NumPy.
"""
import subprocess
import sys

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]


def tetrahedra(count, random):
    """Corners (4 * count, 4, 3): plain ones, and ones squeezed to slivers and caps, needles, and wedges."""
    plain = random.uniform(-1, 1, (count, 4, 3))
    flat, thin, wedge = (random.uniform(-1, 1, (count, 4, 3)) for _ in range(3))
    squeeze = 10.0 ** random.uniform(-3, 0, (count, 1))
    flat[:, :, 2] *= squeeze
    thin[:, :, :2] *= squeeze[:, :, None]
    wedge[:, 1] = wedge[:, 0] + squeeze * (wedge[:, 1] - wedge[:, 0])
    corners = np.concatenate([plain, flat, thin, wedge])
    axes, _ = np.linalg.qr(random.normal(size=(len(corners), 3, 3)))
    scale = 10.0 ** random.uniform(-1, 1, (len(corners), 1, 1))
    corners = np.einsum("nij,nkj->nki", axes, corners) * scale + random.uniform(-10, 10, (len(corners), 1, 3))
    inverted = volumes(corners) < 0
    corners[inverted, 2], corners[inverted, 3] = corners[inverted, 3], corners[inverted, 2].copy()
    return corners[volumes(corners) > 0]


def volumes(p):
    return np.einsum("ij,ij->i", p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0])) / 6


def dihedrals(p):
    """At the six edges, between the two faces' in-plane normals to the edge."""
    out = []
    for a, b in EDGES:
        c, d = (k for k in range(4) if k not in (a, b))
        along = p[:, b] - p[:, a]
        along /= np.linalg.norm(along, axis=1)[:, None]
        u, v = (p[:, k] - p[:, a] for k in (c, d))
        u, v = (w - (w * along).sum(1)[:, None] * along for w in (u, v))
        out.append(np.degrees(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(1))))
    return np.stack(out, axis=1)


def by_vtk(corners):
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(corners.reshape(-1, 3), deep=1))
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    for t in range(len(corners)):
        grid.InsertNextCell(vtk.VTK_TETRA, 4, [4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3])
    out = {}
    for name in ["RadiusRatio", "Shape", "AspectRatio", "EdgeRatio", "Volume"]:
        quality = vtk.vtkMeshQuality()
        quality.SetInputData(grid)
        getattr(quality, f"SetTetQualityMeasureTo{name}")()
        quality.Update()
        out[name] = vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality")).copy()
    return out


def main():
    corners = np.ascontiguousarray(tetrahedra(2500, np.random.default_rng(5)))
    run = subprocess.run([sys.argv[1]], input=corners.tobytes(), stdout=subprocess.PIPE, check=True)
    ours = np.frombuffer(run.stdout).reshape(len(corners), 16)
    volume, edges, angles = ours[:, 0], ours[:, 1:7], ours[:, 7:13]
    theirs = by_vtk(corners)
    # What rounding of the corners alone does to the shape of the flattest.
    rounding = 2.0**-52 * np.abs(corners).max((1, 2)) * edges.max(1) ** 2 / volume
    pairs = {
        "volume, relative": (volume / theirs["Volume"], 1),
        "radius ratio, relative": (ours[:, 13] * theirs["RadiusRatio"], 1),
        "mean ratio, relative": (ours[:, 14] / theirs["Shape"], 1),
        "aspect ratio, relative": (ours[:, 15] / theirs["AspectRatio"], 1),
        "edge ratio, relative": (edges.max(1) / edges.min(1) / theirs["EdgeRatio"], 1),
        "dihedral angles against NumPy, radians": (np.radians(angles), np.radians(dihedrals(corners))),
    }
    failed = False
    for name, (a, b) in pairs.items():
        error = np.abs(a - b)
        error = error.max(1) if error.ndim == 2 else error
        worst = (error / rounding).max()
        bad = not worst < 64
        failed |= bad
        print(f"{'FAILED' if bad else 'ok    '} {name}: largest error {error.max():.2e}, {worst:.1f} roundings")
    print(f"{len(corners)} tetrahedra, smallest dihedral angle {angles.min():.4f}, largest {angles.max():.4f} deg, "
          f"mean ratio down to {ours[:, 14].min():.1e}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
