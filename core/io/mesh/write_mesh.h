// Tetrahedral and surface meshes -> the bytes of files that simulation codes and viewers read.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/shared/mesh_format.h"
#include "types/result.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// VTU: binary appended raw, zlib-free, cell array `label`, mm. MSH 4.1: binary, physical groups per label
/// (volumes, named) and per pair of sides (surfaces). MEDIT: ASCII, mm. openCARP: .pts (um), .elem (Tt,
/// label), .lon (fibres; without them .lon.txt, which says so). Abaqus .inp: element sets, and
/// element surfaces per pair of sides. FEBio .feb 4.0: parts with a material each, surfaces per pair. XDMF 3:
/// .xdmf with its numbers in .h5. Legacy VTK, MSH 2.2, Nastran .bdf, TetGen .node, .ele and .face: ASCII,
/// mm. STL (binary) and PLY (binary): boundary faces, all or an STL for each label. Cell data: arrays in VTU,
/// VTK and XDMF, a _data.msh beside MSH, a .sol beside MEDIT, one .NAME.dat each
/// beside openCARP, one .NAME.inp each beside Abaqus, mesh data in FEBio. Point data: in VTU, VTK, XDMF and
/// openCARP alike. Named surfaces: .NAME.surf and .NAME.surf.vtx beside openCARP, physical groups in MSH,
/// surfaces in Abaqus and FEBio, .surfaces.vtu beside VTU, .surfaces.vtk beside VTK, .facets.xdmf beside
/// XDMF, loads in Nastran, markers in TetGen; not in the others. Second-order
/// elements (WriteMeshOptions::midside): in VTU, MSH, Abaqus, FEBio and XDMF. Every file whose format has a
/// place for it says its space and unit; the header of each format (write_vtu.h, write_msh.h, ...) says
/// where, and the details. The flip to LPS is a rotation: orientation stays. Equal meshes give equal bytes.
/// Errors: kUsage for a mesh without tetrahedra, or without faces where only these are written; kInternal
/// where the mesh breaks an invariant of TetMesh (indices in range, finite points, one label per element) or
/// cell data have a name that is no word or not one value per tet; kUsage for a name that XDMF cannot refer
/// to, and for vectors and point data that the format has no place for (has_place_for), and for second-order
/// elements in others than has_second_order() formats.
Result<std::vector<OutputFile>> write_tet_mesh(const TetMesh& mesh, MeshFormat format,
                                               const WriteMeshOptions& options);

/// The files of a mesh with this path, without those of its data; for most formats only the path itself. Of
/// openCARP's .lon and .lon.txt write_files() writes one.
std::vector<std::string> files_of_mesh(const std::string& path);

/// STL, PLY, VTU, VTK (triangles with cell arrays `label_behind`, `label_front`) of a surface. Errors: kUsage
/// for others.
Result<std::vector<OutputFile>> write_surface(const SurfaceMesh& surface, MeshFormat format,
                                              const WriteMeshOptions& options);

/// Writes each file to a temporary name beside its target ("a.vtu.part"), then renames. `path` carries any
/// known ending: "a.carp" or "a.pts" -> a.pts, a.elem, ... On failure none of the new files remains.
/// Errors: kUsage for an unknown ending; kBadInput naming the path that cannot be written.
Status write_files(const std::string& path, const std::vector<OutputFile>& files);

}  // namespace voxtet
