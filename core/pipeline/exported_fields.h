// The fields that are written with a mesh into its file.
#pragma once

#include <vector>

#include "pipeline/session.h"
#include "types/field.h"

namespace voxtet {

/// Fields on the tetrahedra of Session::mesh(): those of the label transfer and, with `measures`, those of
/// the quality report that have a finite value everywhere.
std::vector<Field> exported_fields(const Session& session, bool measures);

/// Fields on the points of Session::mesh(): what simulations found.
std::vector<Field> exported_point_fields(const Session& session);

}  // namespace voxtet
