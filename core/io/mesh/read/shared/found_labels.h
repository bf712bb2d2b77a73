// What files give tetrahedra for labels -> labels.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/read/shared/mesh_arrays.h"
#include "io/mesh/read/shared/mesh_cursor.h"
#include "types/tet_mesh.h"

namespace voxtet {

void add_note(MeshArrays* arrays, const std::string& note);

/// Gives tetrahedra the labels that a file has for them. A value that is no label, since it is not 1 to
/// 65535, becomes the smallest label that the file does not use: in ascending order, with a note. `what`
/// names the values: "reference". Fails where there are more than 65535 different ones.
void set_labels(MeshCursor& in, TetMesh& mesh, const std::vector<std::int64_t>& values,
                const std::string& what, MeshArrays* arrays);

/// Makes all tetrahedra one region, of label 1; the note says why: "no cell array label".
void set_one_region(TetMesh& mesh, const std::string& why, MeshArrays* arrays);

/// Of tetrahedra with points on their edges the corners were read: leaves out the points that no tetrahedron
/// has for a corner, with a note. `curved` is the number of such tetrahedra; nothing is done where it is 0.
void keep_corners(TetMesh& mesh, std::uint64_t curved, MeshArrays* arrays);

/// Names of labels as bytes with a zero behind each, in the order of `labels`. Ends where one is not whole.
std::vector<LabelInfo> named_labels(const std::vector<std::int64_t>& labels,
                                    const std::vector<std::int64_t>& bytes);

/// Labels of parts that have names, as "LV_myocardium_1" (word_name): the number at the end of the name,
/// where all have one and no two the same; otherwise 1, 2, ... in the order of the parts. Adds the names,
/// without their numbers where these are the labels, to `infos`.
std::vector<std::int64_t> labels_of_parts(const std::vector<std::string>& names,
                                          std::vector<LabelInfo>& infos);

}  // namespace voxtet
