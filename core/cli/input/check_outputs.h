// Checks that no command overwrites a file that it reads.
#pragma once

#include <string>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// A file that a command reads or writes, and the word by which the user named it ("-o", "--mask", "input").
struct NamedPath {
  std::string word, path;
};

/// Checks that every output can be written and is neither an input nor another output; empty paths do not
/// count. A mesh file stands for the files of files_of_mesh(). Call it before anything is read, since a run
/// may take long. Errors: kUsage naming both words and the file, or those of check_place().
Status check_outputs(const std::vector<NamedPath>& outputs, const std::vector<NamedPath>& inputs);

/// Checks that no fibres of another mesh lie where openCARP would take them for those of one that is written
/// without any. Errors: kUsage naming the .lon.
Status check_no_fibres(const NamedPath& output);

}  // namespace voxtet
