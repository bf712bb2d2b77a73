// Checks written as GoogleTest assertions, for programs that count failures instead of stopping at them.
#pragma once

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <string>

namespace voxtet::test {

/// What the assertions in `check` had to say, one line each; empty when all hold.
template <class Check>
std::string caught_failures(Check&& check) {
  ::testing::TestPartResultArray results;
  {
    const ::testing::ScopedFakeTestPartResultReporter reporter(
        ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
    check();
  }
  std::string text;
  for (int i = 0; i < results.size(); ++i) {
    std::string message = results.GetTestPartResult(i).message();
    for (char& c : message)
      if (c == '\n') c = ' ';
    text += (i ? "\n" : "") + message;
  }
  return text;
}

}  // namespace voxtet::test
