// The fields that go with a mesh into its file.
#pragma once

#include <vector>

#include "pipeline/session.h"
#include "types/field.h"

namespace voxtet {

/// Fields of the tetrahedra of Session::mesh(): what was transferred, and with `measures` those of the
/// evidence that have a finite value everywhere.
std::vector<Field> exported_fields(const Session& session, bool measures);

}  // namespace voxtet
