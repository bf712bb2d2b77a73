// The adapted surface and the sizing field in a file, so that every mesher starts from the same bytes in a
// process of its own.
#pragma once

#include <string>

#include "types/result.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::peers {

/// What a mesher that fills surfaces is given.
struct FillTask {
  SurfaceMesh surface;
  SizingField sizing;
};

/// In this machine's own byte order: the file is read where it was written. Errors: kBadInput naming the
/// file.
Status write_fill_task(const FillTask& task, const std::string& path);
Result<FillTask> read_fill_task(const std::string& path);

}  // namespace voxtet::peers
