// The heart of a session under pressure, as a case for programs of mechanics.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/write_mechanics_case.h"
#include "pipeline/session.h"
#include "types/result.h"

namespace voxtet {

/// Passive inflation (write_mechanics_case.h): the mesh and its named surfaces, the base held, a pressure of
/// 1 kPa in 10 steps in every cavity, the material and the bulk modulus of physics.mechanics or its defaults.
/// Needs results of kAnatomy and kFibres. Errors: kUsage where the case asks for no surfaces or fibres, where
/// there is no base, where a cavity is meshed, and for a material other than transversely isotropic and
/// Mooney and Rivlin's; those of write_mechanics_case().
Result<std::vector<OutputFile>> mechanics_case_files(const Session& session, MechanicsProgram program,
                                                     WriteMeshOptions options);

}  // namespace voxtet
