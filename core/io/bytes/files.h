// Files on disk: read as a whole; written as a whole or not at all.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/bytes.h"
#include "types/result.h"

namespace voxtet {

/// Errors: kBadInput naming the path and the system's reason.
Result<Bytes> read_file(const std::string& path);

/// All of standard input, and all to standard output. Errors: kBadInput with the system's reason.
Result<Bytes> read_standard_input();
Status write_standard_output(std::span<const std::uint8_t> bytes);

/// A file to be written.
struct TargetFile {
  std::string path;
  std::span<const std::uint8_t> bytes;
};

/// Writes every file to a new temporary one beside its target, then renames; on failure none of them remains.
/// Links are followed; devices and pipes are written to directly. Errors: kBadInput naming the path and the
/// system's reason.
Status place_files(const std::vector<TargetFile>& files);

/// Whether a file could be placed there, to check before long computations. The same errors.
Status check_place(const std::string& path);

/// The same for one text.
Status write_text_file(const std::string& path, const std::string& text);

}  // namespace voxtet
