"""Reads every mesh format that voxtet writes with tools of other people, and lets voxtet read what those write.

Sample run: read_back.py build/native/tests/unit/io/mesh_files

1. written_meshes.py: VTK, meshio, Gmsh and numpy parsers read the cube of tests/support/labelled_mesh.h, in RAS and LPS:
   points to 1e-12 mm (32-bit formats: 1e-6 of their size), tetrahedra, labels, sides, names of groups, positive volumes,
   cell data. written_solver_files.py: CalculiX, meshio, h5py and an XML parser read the formats of solvers; CalculiX
   measures volumes, areas and normals. written_text_formats.py: VTK, meshio and Gmsh read those of text. written_second_order.py: all of
   them read tetrahedra of ten nodes.
2. foreign_meshes.py: VTK, meshio and Gmsh write the cube in every variant of their formats; voxtet must read the same mesh.
Exit code 77: something that this needs is absent.
"""
import pathlib
import subprocess
import sys
import tempfile

from cube_files import Cube
import foreign_meshes
import written_meshes
import written_second_order
import written_solver_files
import written_text_formats


def main():
    tool = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([tool, "write", name], check=True)
        for space in ("ras", "lps"):
            cube = Cube(folder, space)
            for part in (written_meshes, written_solver_files, written_text_formats, written_second_order):
                for check in part.CHECKS:
                    check(cube, folder, space)
        cube = Cube(folder, "ras")
        for check in foreign_meshes.CHECKS:
            check(tool, cube, folder)
        print(f"{len(cube.tets)} tetrahedra, {len(cube.faces)} faces: {len(list(folder.iterdir()))} files agree")


if __name__ == "__main__":
    main()
