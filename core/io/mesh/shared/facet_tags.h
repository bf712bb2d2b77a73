// One number for each boundary face, where a format has place for no more.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh/shared/mesh_format.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Tags from 1 on: first the distinct pairs of sides, ascending, then the named surfaces in their order. A
/// face of a named surface has the tag of that surface, and every other face that of its pair.
struct FacetTags {
  std::vector<std::int32_t> of_face;
  std::vector<std::string> names;  ///< of tag 1, 2, ...: "LV|background", ..., "cut_superior", ...
};
FacetTags facet_tags(const TetMesh& mesh, const WriteMeshOptions& options);

/// What the tags mean that faces have, for the comments of a file: "1 LV|background", "4 cut_superior".
std::vector<std::string> facet_legend(const FacetTags& tags);

/// The same for the labels of tetrahedra, all of them: "1 LV", "7 label 7".
std::vector<std::string> label_legend(const TetMesh& mesh, const std::vector<LabelInfo>& infos);

/// The text with an underscore for each run of bytes beyond ASCII: for formats whose readers know no other
/// letters.
std::string in_ascii(const std::string& text);

}  // namespace voxtet
