// What every peer program does around its mesher: processor time and memory of the mesher alone, and the
// results.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "types/tet_mesh.h"

namespace voxtet::peers {

/// Processor seconds of `work`, all threads.
double seconds_of(const std::function<void()>& work);

/// Writes OUT.json, and OUT.vtu where there is a mesh. Returns the exit code.
int finish(const std::string& out, const TetMesh& mesh, const nlohmann::json& figures);

}  // namespace voxtet::peers
