// Commands of the command line, run in a folder of their own.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/bytes/files.h"
#include "support/test_folder.h"

namespace voxtet {

class CliTest : public test::FolderTest {
 protected:
  static int run(const std::vector<std::string>& words) {
    std::vector<const char*> argv{"voxtet"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return run_cli(static_cast<int>(argv.size()), argv.data());
  }
  nlohmann::json read_json(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes.ok() ? nlohmann::json::parse(bytes->begin(), bytes->end()) : nlohmann::json();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator{}));
  }
};

inline constexpr const char* kSphere =
    R"({"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[1,1,1]}},"sizing":{"edge_mm":3}})";

}  // namespace voxtet
