// A case of mechanics for FEBio 4: what write_mechanics_case() does, without its checks.
#pragma once

#include <vector>

#include "io/mesh/write_mechanics_case.h"

namespace voxtet {

std::vector<OutputFile> write_febio_case(TetMesh mesh, const MechanicsCase& wanted,
                                         const WriteMeshOptions& options);

}  // namespace voxtet
