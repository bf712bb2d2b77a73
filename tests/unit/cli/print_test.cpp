#include "cli/print.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace voxtet {
namespace {

std::string printed(const std::function<void(std::FILE*)>& print) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  print(file.get());
  std::rewind(file.get());
  std::string text;
  for (int c = std::fgetc(file.get()); c != EOF; c = std::fgetc(file.get())) text += static_cast<char>(c);
  return text;
}

TEST(PrintStages, PutsNotesBelowTheirStageInOneColumn) {
  const nlohmann::json stages{
      {{"name", "sizing"}, {"seconds", 0.5}, {"peak_mb", 8}, {"notes", nlohmann::json::array()}},
      {{"name", "remesh"}, {"seconds", 1.25}, {"peak_mb", 40}, {"notes", {"method delaunay", "as asked"}}}};
  EXPECT_EQ(printed([&](std::FILE* out) { print_stages(stages, out); }),
            "sizing      0.50 s        8 MB peak\n"
            "remesh      1.25 s       40 MB peak\n"
            "           method delaunay\n"
            "           as asked\n"
            "total       1.75 s\n");
}

#ifndef __EMSCRIPTEN__  // whose standard error cannot be captured
TEST(PrintingContext, TimesAStageWhosePartsBeginAtZeroAsOne) {
  testing::internal::CaptureStderr();
  const RunContext ctx = printing_context(0, 1);
  ctx.progress("sizing", 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  ctx.progress("sizing", 0);
  ctx.progress("sizing", 1);
  ctx.progress("sizing", 1);
  const std::string text = testing::internal::GetCapturedStderr();
  double seconds = 0;
  EXPECT_EQ(std::sscanf(text.substr(text.rfind("sizing")).c_str(), "sizing %lf s", &seconds), 1) << text;
  EXPECT_GE(seconds, 0.05);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}
#endif

}  // namespace
}  // namespace voxtet
