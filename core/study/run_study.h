// All cases of a study, or a chunk of them, each in a process of its own; what is done is not done again.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/run_case.h"
#include "study/study.h"

namespace voxtet {

/// Every `of`-th case from `index` on, counted from 1.
struct Chunk {
  std::size_t index = 1, of = 1;
};

/// The cases of a chunk.
std::vector<const StudyCase*> cases_of_chunk(const Study& study, const Chunk& chunk);

struct StudyRun {
  std::string out;  ///< folder; made where it is not there
  Chunk chunk;
  int jobs = 1;  ///< cases at once; WebAssembly has one at a time, in the process itself
  CaseLimits limits;
  /// Is told of each case that has ended, or that was there before; `record` is null where it could not be
  /// written.
  std::function<void(const StudyCase&, const nlohmann::ordered_json& record, bool was_there)> on_case;
};

/// The record of a case in the folder of the study; null where there is none that can be read.
nlohmann::ordered_json record_at(const std::string& out, const std::string& key);

/// Runs the cases that have no record, and those whose record says that the machine failed. A case that fails
/// is a record like any other. Records and files are placed as a whole or not at all, so that any number of
/// such runs may work in one folder and be killed at any time. Errors: kBadInput if the folder cannot be
/// made, or if the records of some cases could not be written, which says how many; all others are done.
Status run_study(const Study& study, const StudyRun& run);

}  // namespace voxtet
