// Which engine this is.
#pragma once

#include <string>

namespace voxtet {

/// Release number and a digest of the sources that decide the bytes of a mesh, "0.2.0+1f0c8a52b9de": two
/// engines with the same version make the same meshes. The same natively and as wasm. Stands in reports,
/// links, cases and the keys of stages.
std::string engine_version();

/// Likewise of `anatomy` and `physics`. What a simulation finds on a mesh depends on both versions: how the
/// stages use the physics is among the sources of the other one.
std::string physics_version();

}  // namespace voxtet
