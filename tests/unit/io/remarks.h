// Volumes read by options, and what is said of them.
#pragma once

#include "unit/io/volume_files.h"

namespace voxtet::test {

inline Result<LabelVolume> read(const Bytes& bytes, const ReadOptions& options, ReadRemarks& remarks,
                                SiblingReader sibling = {}) {
  return read_volume({"sample", bytes, std::move(sibling)}, options, &remarks);
}

/// One of the lines must hold these words.
inline void expect_remark(const std::vector<std::string>& lines, const std::string& words) {
  const bool found = std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find(words) != std::string::npos;
  });
  std::string all;
  for (const std::string& line : lines) all += "\n" + line;
  EXPECT_TRUE(found) << "\"" << words << "\" is not among" << all;
}

}  // namespace voxtet::test
