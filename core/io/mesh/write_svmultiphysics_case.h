// A case of mechanics for svMultiPhysics: what write_mechanics_case() does, without its checks.
#pragma once

#include <vector>

#include "io/mesh/write_mechanics_case.h"

namespace voxtet {

/// Errors: kInternal for faces on no tetrahedron.
Result<std::vector<OutputFile>> write_svmultiphysics_case(const TetMesh& mesh, const MechanicsCase& wanted,
                                                          const WriteMeshOptions& options);

}  // namespace voxtet
