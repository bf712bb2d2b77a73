// The heart of a session under pressure, as a case for programs of mechanics.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/write_mechanics_case.h"
#include "pipeline/session.h"
#include "types/result.h"

namespace voxtet {

/// Passive inflation (write_mechanics_case.h): the mesh and its named surfaces, the base held, a pressure of
/// 1 kPa in 10 steps in every cavity, the default TransverselyIsotropic with the bulk modulus of Muscle.
/// Needs results of kAnatomy and kFibres. Errors: kUsage where the case asks for no surfaces or fibres, where
/// there is no base, or where a cavity is meshed; those of write_mechanics_case().
Result<std::vector<OutputFile>> mechanics_case_files(const Session& session, MechanicsProgram program,
                                                     WriteMeshOptions options);

}  // namespace voxtet
