// A mesh of tetrahedra that was made elsewhere, in the place of the stages that would have made one.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/read_mesh.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"
#include "volume/select_labels.h"

namespace voxtet {

/// Its tetrahedra keep the order of the file, and its points too where all are used.
struct OpenedMesh {
  TetMesh mesh;
  Fibres fibres;  ///< of the tetrahedra; empty where the file has none, `sheet` also where it has no sheets
};

/// Whether a file holds tetrahedra, by its ending.
bool is_mesh_name(const std::string& name);

/// Reads a file of tetrahedra (io/mesh/read_mesh.h; openCARP with its .lon) and adds the faces of its labels.
/// Inverted tetrahedra are turned, and points that no tetrahedron uses are left out, with a warning. Fibres
/// and sheets are scaled to unit length. Errors: those of read_tet_mesh().
Result<OpenedMesh> open_mesh(const VolumeFile& file, std::vector<std::string>& warnings);

/// digest_of(mesh); with fibres, of that and of them.
std::string digest_of(const OpenedMesh& opened);

/// The labels of a mesh on cubes in RAS, with a margin of two: eight for each tetrahedron of the label with
/// the smallest, but at most some 16 million in all.
LabelVolume voxels_of(const TetMesh& mesh);

/// The tetrahedra of the labels `wanted` (empty: all), each group of `merge` with its smallest label.
TetMesh mesh_of_labels(const TetMesh& mesh, const std::vector<Label>& wanted,
                       const std::vector<LabelGroup>& merge);
/// The fibres of these tetrahedra.
Fibres fibres_of_labels(const OpenedMesh& opened, const std::vector<Label>& wanted);

}  // namespace voxtet
