// Files on disk: read whole, written whole or not at all.
#pragma once

#include <string>

#include "io/read_volume.h"
#include "types/result.h"

namespace voxtet {

Result<Bytes> read_file(const std::string& path);

/// Writes to a temporary file beside `path`, then renames.
Status write_file(const std::string& path, const void* data, std::size_t size);
Status write_file(const std::string& path, const std::string& text);

}  // namespace voxtet
