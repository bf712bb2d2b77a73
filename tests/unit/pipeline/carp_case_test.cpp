// Cases for openCARP, and its results on the mesh of a session.
#include "pipeline/exports/carp_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/bytes/text_numbers.h"
#include "physics/tissue/conducting_points.h"

namespace voxtet {
namespace {

/// Boxes one in another, of which the inmost does not conduct; by fractions where it is transferred.
Session boxes(const std::string& more) {
  const Result<Recipe> recipe = parse_recipe(
      R"({"source": {"phantom": {"kind": "nested_boxes", "radius_mm": 8, "spacing_mm": [1, 1, 1]}},
          "sizing": {"edge_mm": 3}, )" +
      more + R"("stimuli": [{"centre_mm": [-8, 0, 0], "radius_mm": 3}]}})");
  EXPECT_TRUE(recipe.ok()) << recipe.error().message;
  Session session;
  EXPECT_TRUE(session.set_recipe(*recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kEikonal, ctx);
  EXPECT_TRUE(done.ok()) << done.error().message;
  return session;
}

/// Made once for all tests.
const Session& boxes_with_a_core() {
  static const Session session = boxes(R"("physics": {"tissue": {"kinds": [{"labels": [1, 2]}]}, )");
  return session;
}

std::string dat(const std::vector<float>& values) {
  std::string text;
  for (const float value : values) text += std::to_string(value) + "\n";
  return text;
}

PointValues values_of(const std::vector<float>& values) {
  const std::string text = dat(values);
  Result<PointValues> opened = PointValues::open("lat.dat", {text.begin(), text.end()});
  EXPECT_TRUE(opened.ok()) << opened.error().message;
  return std::move(opened).value();
}

std::string text_of(const std::vector<OutputFile>& files, const std::string& suffix) {
  for (const OutputFile& file : files)
    if (file.suffix == suffix) return {file.bytes.begin(), file.bytes.end()};
  return "none";
}

std::vector<bool> conducting(const Session& session) {
  return conducting_points(*session.mesh(), session.result<TissueResult>(Stage::kTissue)->tissue);
}

TEST(ValuesOnMesh, AreThoseOfAllPoints) {
  const Session& session = boxes_with_a_core();
  std::vector<float> values(session.mesh()->points.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  const Result<Field> field = values_on_mesh(session, values_of(values), 0);
  ASSERT_TRUE(field.ok()) << field.error().message;
  EXPECT_EQ(field->values, values);
}

TEST(ValuesOnMesh, AreSpreadFromThePointsThatConduct) {
  const Session& session = boxes_with_a_core();
  const std::vector<bool> conducts = conducting(session);
  std::vector<float> values;
  for (std::size_t i = 0; i < conducts.size(); ++i)
    if (conducts[i]) values.push_back(static_cast<float>(i));
  ASSERT_LT(values.size(), conducts.size());
  const Result<Field> field = values_on_mesh(session, values_of(values), 0);
  ASSERT_TRUE(field.ok()) << field.error().message;
  ASSERT_EQ(field->values.size(), conducts.size());
  for (std::size_t i = 0; i < conducts.size(); ++i) {
    if (conducts[i])
      EXPECT_EQ(field->values[i], static_cast<float>(i));
    else
      EXPECT_TRUE(std::isnan(field->values[i]));
  }

  values.pop_back();
  const Result<Field> other = values_on_mesh(session, values_of(values), 0);
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().message,
            "lat.dat: found " + std::to_string(values.size()) + " values, expected " +
                std::to_string(conducts.size()) + ", one for each point of the mesh, or " +
                std::to_string(values.size() + 1) + ", one for each point that conducts");
}

TEST(CarpCase, LeavesOutWhatDoesNotConduct) {
  const Session& session = boxes_with_a_core();
  ASSERT_TRUE(has_wave(session));
  const auto files = carp_case_files(session, PatientSpace::kRas, "boxes");
  ASSERT_TRUE(files.ok()) << files.error().message;
  const std::string par = text_of(*files, ".par");
  EXPECT_NE(par.find("\nphys_region[0].num_IDs = 2\nphys_region[0].ID[0] = 1\nphys_region[0].ID[1] = 2\n"),
            std::string::npos)
      << par;
  EXPECT_EQ(par.find("gi_scale"), std::string::npos);
  const std::string expected = text_of(*files, ".expected_ms.dat");
  const std::vector<bool> conducts = conducting(session);
  EXPECT_EQ(std::count(expected.begin(), expected.end(), '\n'),
            std::count(conducts.begin(), conducts.end(), true));
}

TEST(CarpCase, ScalesConductivitiesByTheShareOfTissue) {
  const Session session = boxes(R"("labels": [1, 2, 3], "merge": [[1, 2, 3]], "transfer": {"labels": [2, 3]},
      "physics": {"tissue": {"by": "fraction", "kinds": [{"labels": [1, 2]}]}, )");
  const auto files = carp_case_files(session, PatientSpace::kRas, "boxes");
  ASSERT_TRUE(files.ok()) << files.error().message;
  EXPECT_NE(text_of(*files, ".par").find("\ngi_scale_vec = \"boxes.gi_scale.dat\"\n"), std::string::npos);
  const std::string scale = text_of(*files, ".gi_scale.dat");
  EXPECT_EQ(scale.substr(0, 2), "1\n");
  EXPECT_EQ(static_cast<std::size_t>(std::count(scale.begin(), scale.end(), '\n')),
            session.mesh()->tets.size() + 1);
  // Label 3 does not conduct: where it fills a tetrahedron, nothing is left.
  const Tissue& tissue = session.result<TissueResult>(Stage::kTissue)->tissue;
  EXPECT_EQ(scale, [&] {
    std::string text = "1\n";
    for (const float share : tissue.share) {
      char number[kRealChars];
      text.append(number, format_real(number, share));
      text += "\n";
    }
    return text;
  }());
}

}  // namespace
}  // namespace voxtet
