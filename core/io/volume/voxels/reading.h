// A file being read: how, and what is found on the way.
#pragma once

#include <utility>

#include "types/read_options.h"

namespace voxtet {

struct Reading {
  const ReadOptions& options;
  ReadRemarks remarks{};
  double said_mm = 0;            ///< mm of the unit of length that the file names; 0: it names none
  bool precedence_used = false;  ///< whether the file has segments that may overlap

  void warn(std::string message) { remarks.warnings.push_back(std::move(message)); }
  void note(std::string message) { remarks.notes.push_back(std::move(message)); }
};

}  // namespace voxtet
