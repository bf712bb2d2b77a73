// The files on disk that a case is made of: the case itself, its volume, its masks and images.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/volume_file.h"
#include "pipeline/session.h"
#include "recipe/recipe.h"
#include "types/result.h"

namespace voxtet {

/// The recipe of a case file. Errors: kBadInput if it cannot be read; those of parse_recipe(), which name
/// the file.
Result<Recipe> read_case_file(const std::string& path);

/// The bytes of a file that a case names. Errors: kBadInput if it is no file, as a folder or a pipe, or
/// cannot be read.
Result<Bytes> read_case_bytes(const std::string& path);

/// A file of which the bytes are at hand, with those beside it.
VolumeFile file_at(const std::string& path, std::span<const std::uint8_t> bytes);

/// Reads a file of a path and gives it to `load`. Errors: those of reading it, and of `load`.
using LoadFile = std::function<Status(const VolumeFile&)>;
using OpenFile = std::function<Status(const std::string& path, const LoadFile& load)>;
Status open_case_file(const std::string& path, const LoadFile& load);

/// Where the masks, and the images of edge lengths, are that a recipe names beside its case file.
struct SidePaths {
  std::vector<std::string> masks, images;
};
SidePaths side_paths(const Recipe& recipe, const std::string& folder);

/// Loads them. Errors: those of `open`, load_mask() and load_size_image().
Status load_side_files(const SidePaths& paths, Session& session, const OpenFile& open = open_case_file);

}  // namespace voxtet
