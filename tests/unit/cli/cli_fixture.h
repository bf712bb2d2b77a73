// Commands of the command line, run in a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/bytes/files.h"

namespace voxtet {

class CliTest : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("voxtet_cli_" + std::string(info->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  static int run(const std::vector<std::string>& words) {
    std::vector<const char*> argv{"voxtet"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return run_cli(static_cast<int>(argv.size()), argv.data());
  }
  nlohmann::json read_json(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes.ok() ? nlohmann::json::parse(bytes->begin(), bytes->end()) : nlohmann::json();
  }
  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(write_text_file(at(name), text).ok());
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator{}));
  }

  std::filesystem::path folder_;
};

inline constexpr const char* kSphere =
    R"({"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[1,1,1]}},"sizing":{"edge_mm":3}})";

}  // namespace voxtet
