// A test with a folder of its own, which goes with it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/bytes/files.h"

namespace voxtet::test {

class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("voxtet_" + std::string(info->test_suite_name()) + "_" + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  /// The path of a file with this text.
  std::string write(const std::string& name, const std::string& text) const {
    EXPECT_TRUE(write_text_file(at(name), text).ok());
    return at(name);
  }

  std::filesystem::path folder_;
};

}  // namespace voxtet::test
