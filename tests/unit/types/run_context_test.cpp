#include "types/run_context.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace voxtet {
namespace {

TEST(RunContext, TellsOfPartsWithinPartsAndNeverLessThanBefore) {
  std::vector<double> told;
  RunContext whole;
  whole.on_progress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "stage");
    told.push_back(fraction);
  };
  const RunContext first = whole.part(0, 0.5), second = whole.part(0.5, 1), inner = second.part(0.5, 1);
  first.progress("stage", 0);
  first.progress("stage", 1);
  first.progress("stage", 0.2);
  second.progress("stage", 0.5);
  inner.progress("stage", 0);
  inner.progress("stage", 1);
  EXPECT_EQ(told, (std::vector<double>{0, 0.5, 0.5, 0.75, 0.75, 1}));
}

TEST(RunContext, AsksNobodyWhereNobodyListens) {
  RunContext().part(0.2, 0.4).progress("stage", 1);
  EXPECT_FALSE(RunContext().part(0.2, 0.4).cancelled());
}

TEST(RunContext, HandsCancellationAndWarningsThrough) {
  std::vector<std::string> warnings;
  RunContext whole;
  whole.on_cancelled = [] { return true; };
  whole.on_warning = [&](const std::string&, const std::string& text) { warnings.push_back(text); };
  const RunContext part = whole.part(0, 0.1);
  part.warn("stage", "thin");
  EXPECT_TRUE(part.cancelled());
  EXPECT_EQ(warnings, std::vector<std::string>{"thin"});
}

}  // namespace
}  // namespace voxtet
