#include "cli/print.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

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

}  // namespace
}  // namespace voxtet
