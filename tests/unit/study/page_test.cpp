#include "study/page/page.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/page/outliers.h"
#include "study/page/plot.h"

namespace voxtet {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Json> rows_of(const std::vector<double>& values) {
  std::vector<Json> rows;
  rows.reserve(values.size() + 1);
  for (const double value : values) rows.push_back({{"x", value}});
  rows.push_back({{"x", nullptr}});
  return rows;
}

TEST(Outliers, AreBeyondTheOuterFences) {
  // Twelve values, quartiles 10 and 12 (the fourth and the tenth): the fences are at 4 and 18.
  const std::vector<Outlier> found =
      find_outliers(rows_of({9, 9, 10, 10, 10, 11, 11, 12, 12, 12, 3.9, 18.5}), {"x", "y"});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].row, 11U);
  EXPECT_EQ(found[0].value, 18.5);
  EXPECT_EQ(found[0].median, 11);
  EXPECT_NEAR(found[0].beyond, 3.25, 1e-12);
  EXPECT_EQ(found[1].row, 10U);
}

TEST(Outliers, AreAllThatDifferWhereMostValuesAreOne) {
  ASSERT_EQ(find_outliers(rows_of({1, 1, 1, 1, 50}), {"x"}).size(), 1U);
  EXPECT_TRUE(find_outliers(rows_of({1, 1, 1}), {"x"}).empty());
  EXPECT_TRUE(find_outliers(rows_of({}), {"x"}).empty());
  EXPECT_TRUE(find_outliers({}, {"x"}).empty());
}

TEST(Plot, TicksAreRoundAndHoldTheValues) {
  EXPECT_EQ(round_ticks(0, 10), (std::vector<double>{0, 5, 10}));
  EXPECT_EQ(round_ticks(16718, 31190), (std::vector<double>{15000, 20000, 25000, 30000, 35000}));
  EXPECT_EQ(round_ticks(0, 2, 1), (std::vector<double>{0, 1, 2}));
  for (const auto& [low, high] : {std::pair{3., 3.},
                                  {0.99, std::nextafter(0.99, 1)},
                                  {0., 0.},
                                  {-7., -7.},
                                  {1e-9, 2e-9},
                                  {-3e7, 5e8}}) {
    const std::vector<double> ticks = round_ticks(low, high);
    EXPECT_LE(ticks.front(), low);
    EXPECT_GE(ticks.back(), high);
    EXPECT_GE(ticks.size(), 3U);
    EXPECT_LE(ticks.size(), 9U);
  }
}

TEST(Plot, EveryValueIsInABar) {
  const std::string svg = histogram_svg("x & y", {0, 0, 1, 5, 10, 10, 10});
  EXPECT_NE(svg.find("x &amp; y"), std::string::npos);
  EXPECT_NE(svg.find("3 cases from 7.5 to 10"), std::string::npos) << svg;
  EXPECT_NE(svg.find("3 cases from 0 to 2.5"), std::string::npos) << svg;
}

StudyTable small_table() {
  StudyTable table;
  for (int i = 1; i <= 9; ++i) {
    const bool failed = i == 3;
    table.rows.push_back(
        {{"case", i},
         {"key", "k" + std::to_string(i)},
         {"name", i == 3 ? "<bad>" : "heart " + std::to_string(i)},
         {"status", failed ? "failed" : "done"},
         {"stage", failed ? Json("volume") : Json(nullptr)},
         {"reason", failed ? Json("a \"broken\" file, as it seems") : Json(nullptr)},
         {"tets", failed ? Json(nullptr) : Json(1000 + i)},
         {"smallest_dihedral_deg", failed ? Json(nullptr) : Json(i == 9 ? 5. : 30 + 0.1 * i)},
         {"lv_ejection_fraction", nullptr},
         {"link", "#c1=" + std::to_string(i)}});
    table.costs.push_back(
        {{"case", i}, {"seconds", 2}, {"peak_mb", 10 + i}, {"forecast_seconds", 1}, {"forecast_mb", 9}});
  }
  return table;
}

TEST(Page, SaysWhatBecameOfEachCase) {
  Study study;
  study.title = "Hearts & more";
  const std::string page = study_page(study, small_table(), "https://host/app/");
  for (const char* text :
       {"<title>Hearts &amp; more</title>",
        "9 cases: 8 done, 1 failed, 0 not run. 18 s in all, at most 19 MB a case.",
        "<a href=\"https://host/app/#c1=3\">&lt;bad&gt;</a>", "a &quot;broken&quot; file", "pictures/k9.png",
        "Smallest dihedral angle, degrees: 5 (median 30.5)", "1 of the cases have a figure"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("lv_ejection_fraction"), std::string::npos);  // a column that no case has
}

TEST(Table, CsvQuotesWhatItMust) {
  const std::vector<Json> rows{{{"a", "x, \"y\""}, {"b", nullptr}, {"c", 0.1}, {"d", true}}};
  EXPECT_EQ(csv_of(rows), "a,b,c,d\n\"x, \"\"y\"\"\",,0.1,true\n");
  EXPECT_EQ(json_lines_of(rows), "{\"a\":\"x, \\\"y\\\"\",\"b\":null,\"c\":0.1,\"d\":true}\n");
  EXPECT_EQ(csv_of({}), "");
}

}  // namespace
}  // namespace voxtet
