// FEBio input file .feb of version 4.0 (S. Maas et al., "FEBio User's Manual", "Free Format Input").
#pragma once

#include <string>

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The mesh with everything else that FEBio requires, except analysis, boundary conditions and loads. One
/// Elements section of type tet4 per label, each with a solid domain and a material; a Surface of tri3 per
/// pair of sides, normal from the first to the second; all named by word_name. A Surface per named surface.
/// Node id = point index + 1, element id = place in the mesh + 1. The module's units are mm-kg-s, so stresses
/// are kPa; a comment gives the space. Every material is neo-Hookean, E 10 kPa, v 0.45, 1060 kg/m^3: start
/// values, as a comment says. Cell data: an ElementData section per part, which a parameter of type "map" can
/// refer to.
Bytes write_febio(const TetMesh& mesh, const WriteMeshOptions& options);

/// What makes an analysis of a mesh, as FEBio's XML.
struct FebioAnalysis {
  const Field *fibre = nullptr, *sheet = nullptr;  ///< of the tetrahedra; zeros where there are none
  std::string control;                             ///< the section Control
  /// A material with its attribute type, as `type="x">...`, of parts with fibres and of those without.
  std::string muscle, passive;
  std::string domain;  ///< attributes of a SolidDomain
  std::string end;     ///< the sections Boundary, Loads, LoadData and Output
};

/// The mesh with an analysis. Instead of cell data, a part with fibres has its axes: ElementData of the type
/// mat_axis, `a` the fibre and `d` the sheet. A part has fibres if its first tetrahedron has one.
Bytes write_febio(const TetMesh& mesh, const WriteMeshOptions& options, const FebioAnalysis& analysis);

}  // namespace voxtet
