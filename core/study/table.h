// The results of a study as a table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/study.h"

namespace voxtet {

/// A study's folder, read: a row and the cost of each case.
struct StudyTable {
  std::vector<nlohmann::ordered_json>
      rows;  ///< case, key, name, what varies, status, stage, reason, figures, link
  std::vector<nlohmann::ordered_json> costs;  ///< case, seconds, peak_mb, forecast_seconds, forecast_mb
};

/// Of a case without a record the status is "missing". Rows depend on the study and its results alone, not on
/// when and how it was run; costs do.
StudyTable read_table(const Study& study, const std::string& out);

/// How many have that status.
std::size_t count_of(const std::vector<nlohmann::ordered_json>& rows, const char* status);

/// A line of names and one for each object, by RFC 4180. Absent values are empty. All have the same fields.
std::string csv_of(const std::vector<nlohmann::ordered_json>& rows);
/// An object a line.
std::string json_lines_of(const std::vector<nlohmann::ordered_json>& rows);

}  // namespace voxtet
