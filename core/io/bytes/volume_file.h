// A file to be read: its bytes, its name, and the files beside it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "io/bytes/bytes.h"
#include "types/result.h"

namespace voxtet {

/// Gives the content of a file named by a detached header (.nhdr, .mhd), relative to that header.
/// In the browser these are the files dropped together with it.
using SiblingReader = std::function<Result<Bytes>(const std::string& name)>;

struct VolumeFile {
  std::string name;  ///< used in messages, and to tell .nii.gz from other gzip data
  std::span<const std::uint8_t> bytes;
  SiblingReader sibling;  ///< may be empty when the file is self-contained
};

}  // namespace voxtet
