// How the sweep programs end: rows to a file, failures in words, the exit code.
#pragma once

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "types/result.h"

namespace voxtet::sweep {

class Findings {
 public:
  /// A row of the JSON file, and what is wrong with it.
  void add(const std::string& name, nlohmann::json row, const std::vector<std::string>& failures) {
    row["case"] = name;
    row["failures"] = failures;
    rows_.push_back(std::move(row));
    for (const std::string& text : failures) failures_.push_back(name + ": " + text);
  }
  void add_error(const std::string& name, const Error& error) {
    add(name, {}, {to_string(error.code) + ": " + error.message});
  }
  /// Writes the file (no name: none), prints the failures. Exit code of the program. No row is a failure:
  /// nothing was measured.
  int finish(const std::string& json_file) {
    if (rows_.empty()) failures_.push_back("no case has such a name");
    if (!json_file.empty())
      std::ofstream(json_file) << nlohmann::json{{"rows", rows_}, {"failures", failures_}}.dump(1) << '\n';
    std::printf("\n%zu failures\n", failures_.size());
    for (const std::string& text : failures_) std::printf("- %s\n", text.c_str());
    return failures_.empty() ? 0 : 1;
  }

 private:
  nlohmann::json rows_ = nlohmann::json::array();
  std::vector<std::string> failures_;
};

}  // namespace voxtet::sweep
