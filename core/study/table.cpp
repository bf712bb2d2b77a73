#include "study/table.h"

#include <algorithm>

#include "study/case_key.h"
#include "study/figures.h"
#include "study/run_case.h"
#include "study/run_study.h"

namespace voxtet {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string csv_field(const Json& value) {
  if (value.is_null()) return "";
  std::string text = value.is_string() ? value.get<std::string>() : text_of(value);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

Json row_of(const StudyCase& one, const std::string& key, const Json& record) {
  Json row{{"case", one.number}, {"key", key}, {"name", one.name}};
  for (const auto& [field, value] : one.varied) row[field] = value;
  const bool missing = record.is_null();
  for (const char* field : {"status", "stage", "reason"})
    row[field] = missing ? Json(nullptr) : record[field];
  if (missing) row["status"] = "missing";
  for (const char* figure : kFigures)
    row[figure] = missing ? Json(nullptr) : record["figures"].value(figure, Json());
  row["link"] = missing ? failed_record(one, key, "", "")["link"] : record["link"];
  return row;
}

Json cost_of(const StudyCase& one, const Json& record) {
  Json cost{{"case", one.number}};
  for (const char* field : {"seconds", "peak_mb", "forecast_seconds", "forecast_mb"})
    cost[field] = record.is_null() ? Json(nullptr) : record["cost"].value(field, Json());
  return cost;
}

}  // namespace

StudyTable read_table(const Study& study, const std::string& out) {
  StudyTable table;
  CaseKeys keys(study.plan);
  for (const StudyCase& one : study.cases) {
    const std::string key = keys.of(one);
    const Json record = record_at(out, key);
    table.rows.push_back(row_of(one, key, record));
    table.costs.push_back(cost_of(one, record));
  }
  return table;
}

std::size_t count_of(const std::vector<Json>& rows, const char* status) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const Json& row) { return row["status"] == status; }));
}

std::string csv_of(const std::vector<Json>& rows) {
  std::string out;
  const auto add_line = [&](const Json& row, bool names) {
    bool first = true;
    for (const auto& [name, value] : row.items()) {
      if (!first) out += ',';
      out += csv_field(names ? Json(name) : value);
      first = false;
    }
    out += "\n";
  };
  if (!rows.empty()) add_line(rows.front(), true);
  for (const Json& row : rows) add_line(row, false);
  return out;
}

std::string json_lines_of(const std::vector<Json>& rows) {
  std::string out;
  for (const Json& row : rows) out += text_of(row) + "\n";
  return out;
}

}  // namespace voxtet
