"""What VTK, meshio and Gmsh write, in every variant of their formats, read by voxtet."""
import subprocess

from cube_files import EXACT_MM, expect, expect_points, expect_same_cells, run_gmsh, vtk_grid
import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


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


def check_reading_legacy_vtk(tool, cube, folder):
    """Versions before and after 5, as text and binary."""
    for space in ("ras", "lps"):
        grid = vtk_grid(folder / f"{space}.vtu")[0]
        for version in (42, 51):
            for binary in (False, True):
                path = folder / f"legacy_{space}_{version}_{binary}.vtk"
                writer = vtk.vtkUnstructuredGridWriter()
                writer.SetFileName(str(path))
                writer.SetInputData(grid)
                writer.SetFileVersion(version)
                writer.SetHeader(f"voxtet mesh, space {space.upper()}")
                writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
                expect(writer.Write() == 1, f"VTK cannot write {path.name}")
                # As text VTK writes eleven digits.
                expect_voxtet_reads(tool, path, cube, path.name, tolerance=0.0 if binary else 1e-9)


def check_reading_text_of_meshio(tool, cube, folder):
    cells = [("tetra", cube.tets)]

    def mesh(name):
        return meshio.Mesh(cube.points, cells, cell_data={name: [cube.labels]})

    for binary in (False, True):
        path = folder / f"meshio_{binary}.vtk"
        meshio.vtk.write(path, mesh("label"), binary=binary)
        expect_voxtet_reads(tool, path, cube, path.name, tolerance=EXACT_MM)
    path = folder / "meshio.node"
    meshio.write(path, mesh("tetgen:ref"))
    expect_voxtet_reads(tool, path, cube, path.name, tolerance=EXACT_MM)
    for name, options in (("xml", {"data_format": "XML"}), ("gzip", {"data_format": "HDF", "compression": "gzip"}),
                          ("plain", {"data_format": "HDF", "compression": None})):
        path = folder / f"meshio_{name}.xdmf"
        meshio.write(path, mesh("label"), **options)
        expect_voxtet_reads(tool, path, cube, path.name, tolerance=EXACT_MM)


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
                # MSH 2.2 with everything has no physical groups: its geometric entities are the labels.
                expect_voxtet_reads(tool, folder / name, cube, name, ordered=False)


CHECKS = (check_reading_vtk, check_reading_legacy_vtk, check_reading_meshio, check_reading_text_of_meshio,
          check_reading_gmsh)
