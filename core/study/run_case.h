// One case of a study, run in this process.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/bytes/bytes.h"
#include "pipeline/forecast.h"
#include "study/study.h"

namespace voxtet {

/// What a case may take of the machine. No result depends on it.
struct CaseLimits {
  int threads = 1;
  double memory_mb = 0;     ///< 0: as much as there is
  double time_limit_s = 0;  ///< 0: as long as it takes
};

/// A file of a case, below the folder of the study.
struct CaseFile {
  std::string path;  ///< as "pictures/KEY.png"
  Bytes bytes;
};

/// {key, status, stage, reason, again, figures, cost, link}. `status` is "done" or "failed". A failure that
/// is the machine's and not the case's (memory, time, a full disk) shall be tried `again`. `cost`: seconds,
/// peak_mb, forecast_seconds, forecast_mb; null where unknown.
struct CaseOutcome {
  nlohmann::ordered_json record;
  std::vector<CaseFile> files;  ///< a picture, and what the study keeps
};

CaseOutcome run_case(const StudyCase& one, const StudyPlan& plan, const std::string& key,
                     const CaseLimits& limits);

/// The record of a case that failed outside of its stages.
nlohmann::ordered_json failed_record(const StudyCase& one, const std::string& key, const std::string& stage,
                                     const std::string& reason);

/// Memory (MB) and time (s) of meshing a case, before that is done. Errors: those of reading it and of the
/// stages up to the sizes.
Result<Forecast> forecast_of(const StudyCase& one, const StudyPlan& plan, const CaseLimits& limits);

}  // namespace voxtet
