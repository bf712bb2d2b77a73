// What finished meshes are measured against: the surface as extracted from the voxels and the same one
// smoothed. Kept in files, so that later trees, whatever surfaces they make, are measured against those of an
// earlier one.
#pragma once

#include <optional>
#include <string>

#include "pipeline/session.h"

namespace voxtet::sweep {

struct Reference {
  SurfaceMesh voxels;    ///< as extracted
  SurfaceMesh smoothed;  ///< the same one, perhaps with fewer points
  std::string digest{};  ///< of both
};

/// Where references are written to, and where they are read from. Without `from`, the session's own surfaces
/// are the reference.
struct ReferenceFolders {
  std::optional<std::string> to, from;
};

/// The reference of a case. Needs a session that has run kSmooth. Errors: kBadInput naming the file that is
/// not there or is none.
Result<Reference> reference_of(const std::string& name, const Session& session,
                               const ReferenceFolders& folders);

}  // namespace voxtet::sweep
