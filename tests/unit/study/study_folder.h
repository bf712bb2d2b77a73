// A folder of its own for a test, with a study of small spheres in it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/bytes/files.h"
#include "study/study.h"

namespace voxtet {

class StudyTest : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("voxtet_study_" + std::string(info->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    EXPECT_TRUE(write_text_file(at(name), text).ok());
    return at(name);
  }
  /// A study file of which these are the fields besides its version and its case.
  Result<Study> study_with(const std::string& fields, const std::string& body = kSphere) const {
    return read_study(
        write("study.json", R"({"study":1,"case":)" + body + (fields.empty() ? "" : ",") + fields + "}"));
  }
  std::string text_of(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes ? std::string(bytes->begin(), bytes->end()) : "";
  }

  static constexpr const char* kSphere =
      R"({"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[2,2,2]}},"sizing":{"edge_mm":4}})";
  std::filesystem::path folder_;
};

}  // namespace voxtet
