// Which tetrahedra conduct, by each rule, and which of their points stimuli excite.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "physics/eikonal/eikonal_sources.h"
#include "physics/tissue/make_tissue.h"
#include "physics/tissue/stimulated_points.h"

namespace voxtet {
namespace {

constexpr std::uint16_t kNone = Tissue::kNone;

/// A strip of tetrahedra along x; only their labels matter.
TetMesh strip(const std::vector<Label>& labels) {
  TetMesh mesh;
  for (std::size_t t = 0; t < labels.size() + 3; ++t)
    mesh.points.emplace_back(static_cast<double>(t), t % 2, t / 2 % 2);
  for (std::uint32_t t = 0; t < labels.size(); ++t) mesh.tets.push_back({t, t + 1, t + 2, t + 3});
  mesh.labels = labels;
  return mesh;
}

Field tet_values(const std::string& name, std::vector<float> values) {
  return {name, "", "1", On::kTets, Scale::kLabel, 1, std::move(values)};
}

/// The transfer of labels 5 and 6 to five tetrahedra.
LabelTransfer transfer() {
  LabelTransfer out;
  out.labels.resize(2);
  out.labels[0].label = 5;
  out.labels[1].label = 6;
  out.fields = {tet_values("centroid_label", {1, 5, 6, 2, 0}), tet_values("majority_label", {1, 1, 6, 5, 2}),
                tet_values("fraction_5", {0, 0.25F, 0.5F, 0.9995F, 0}),
                tet_values("fraction_6", {0, 0.25F, 0.5F, 0, 0.75F})};
  return out;
}

TissueLabels kind(std::vector<Label> labels, double along = 0.5) {
  TissueLabels out;
  out.labels = std::move(labels);
  out.along_mm_per_ms = along;
  return out;
}

const TetMesh kMesh = strip({1, 1, 1, 2, 3});

std::vector<std::uint16_t> kinds_by(TissueBy by, const std::vector<TissueLabels>& kinds) {
  const Result<Tissue> tissue = make_tissue(kMesh, transfer(), {by, kinds});
  EXPECT_TRUE(tissue.ok()) << tissue.error().message;
  return tissue ? tissue->kind : std::vector<std::uint16_t>{};
}

TEST(MakeTissue, TakesTheMeshsLabelThatAtTheCentroidOrTheMajority) {
  const std::vector<TissueLabels> kinds{kind({1, 2}), kind({6}, 0.3)};
  EXPECT_EQ(kinds_by(TissueBy::kMesh, kinds), (std::vector<std::uint16_t>{0, 0, 0, 0, kNone}));
  EXPECT_EQ(kinds_by(TissueBy::kCentroid, kinds), (std::vector<std::uint16_t>{0, kNone, 1, 0, kNone}));
  EXPECT_EQ(kinds_by(TissueBy::kMajority, kinds), (std::vector<std::uint16_t>{0, 0, 1, kNone, 0}));
}

TEST(MakeTissue, KeepsTheKindsInTheirOrderAndHasNoSharesOfWholeLabels) {
  const Result<Tissue> tissue = make_tissue(kMesh, {}, {TissueBy::kMesh, {kind({2}, 0.7), kind({1}, 0.4)}});
  ASSERT_TRUE(tissue.ok()) << tissue.error().message;
  EXPECT_EQ(tissue->kind, (std::vector<std::uint16_t>{1, 1, 1, 0, kNone}));
  ASSERT_EQ(tissue->kinds.size(), 2U);
  EXPECT_EQ(tissue->kinds[0].along_mm_per_ms, 0.7);
  EXPECT_EQ(tissue->kinds[1].along_mm_per_ms, 0.4);
  EXPECT_TRUE(tissue->share.empty());
  EXPECT_TRUE(tissue->fibre.empty());
}

TEST(MakeTissue, ByFractionLowersTheShareByWhatDoesNotConductAndSwitchesToWhatFillsMoreThanHalf) {
  // Label 5 is scar. Label 6 conducts: it takes nothing away, and is the kind where it has more than half.
  const Result<Tissue> tissue =
      make_tissue(kMesh, transfer(), {TissueBy::kFraction, {kind({1, 2}), kind({6})}});
  ASSERT_TRUE(tissue.ok()) << tissue.error().message;
  // The fourth has hardly any tissue left, and is none; the fifth is of a label without tissue.
  EXPECT_EQ(tissue->kind, (std::vector<std::uint16_t>{0, 0, 0, kNone, 1}));
  ASSERT_EQ(tissue->share.size(), 5U);
  const std::vector<float> shares{1, 0.75F, 0.5F, 1 - 0.9995F, 1};
  EXPECT_EQ(tissue->share, shares);
}

TEST(MakeTissue, SaysWhichFieldIsWrong) {
  const auto error_of = [](const TissueParams& params, const LabelTransfer& labels) {
    const Result<Tissue> tissue = make_tissue(kMesh, labels, params);
    if (tissue.ok()) return std::string("none");
    EXPECT_EQ(tissue.error().code, ErrorCode::kUsage);
    EXPECT_EQ(tissue.error().stage, "tissue");
    return tissue.error().message;
  };
  EXPECT_EQ(
      error_of({}, {}),
      "physics.tissue.kinds: found no entry, expected at least one: which labels conduct, and how fast");
  EXPECT_EQ(error_of({TissueBy::kMesh, {kind({1}), kind({})}}, {}),
            "physics.tissue.kinds[1].labels: found no label, expected at least one");
  EXPECT_EQ(error_of({TissueBy::kMesh, {kind({1}), kind({2, 1})}}, {}),
            "physics.tissue.kinds[1].labels: found 1, which has an entry already, expected each label once");
  EXPECT_EQ(error_of({TissueBy::kMesh, {kind({9})}}, {}),
            "physics.tissue.kinds: found no tetrahedron of their labels, expected some of those of the mesh: "
            "1, 2, 3");
  for (const TissueBy by : {TissueBy::kCentroid, TissueBy::kMajority, TissueBy::kFraction})
    EXPECT_EQ(
        error_of({by, {kind({1})}}, {}),
        "physics.tissue.by: found no transferred label to take tissue from, expected transfer.labels to "
        "name some");
}

/// A ball of 1.5 mm around the origin.
Stimulus ball() {
  Stimulus stimulus;
  stimulus.radius_mm = 1.5;
  return stimulus;
}

const std::vector<Eigen::Vector3d> kRow{{0, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {2, 0, 0}, {-1, 0, 0}, {0, 4, 3}};

TEST(StimulatedPoints, AreThoseOfTissueInTheRegionAndOnItsRim) {
  using Points = std::vector<std::uint32_t>;
  const Result<Points> all = stimulated_points(kRow, {}, ball(), "s");
  ASSERT_TRUE(all.ok()) << all.error().message;
  EXPECT_EQ(*all, (Points{0, 1, 2, 4}));
  const Result<Points> some = stimulated_points(kRow, {false, true, true, true, false, true}, ball(), "s");
  ASSERT_TRUE(some.ok()) << some.error().message;
  EXPECT_EQ(*some, (Points{1, 2}));

  Stimulus box = ball();
  box.shape = RegionShape::kBox;
  box.centre_mm = {1, 0, 0};
  box.half_size_mm = {1, 0.5, 0.5};
  EXPECT_EQ(*stimulated_points(kRow, {}, box, "s"), (Points{0, 1, 2, 3}));
  Stimulus capsule = ball();
  capsule.shape = RegionShape::kCapsule;
  capsule.end_mm = {0, 4, 3};
  capsule.radius_mm = 0.25;
  EXPECT_EQ(*stimulated_points(kRow, {}, capsule, "s"), (Points{0, 5}));
}

TEST(StimulatedPoints, SayHowFarAStimulusIsFromTissue) {
  const auto away =
      stimulated_points(kRow, {false, false, false, false, false, true}, ball(), "physics.stimuli[2]");
  ASSERT_FALSE(away.ok());
  EXPECT_EQ(away.error().code, ErrorCode::kUsage);
  EXPECT_EQ(
      away.error().message,
      "physics.stimuli[2]: found no point of conducting tissue in its region, expected at least one; the "
      "nearest is 3.5 mm away");
  Stimulus named = ball();
  named.name = "apex";
  named.centre_mm = {0, 0, -2};
  EXPECT_EQ(stimulated_points(kRow, {}, named, "physics.stimuli[0]").error().message,
            "physics.stimuli[0] (apex): found no point of conducting tissue in its region, expected at least "
            "one; the nearest is 0.5 mm away");
}

TEST(StimulatedPoints, RefuseNumbersOutOfRange) {
  const auto error_of = [](auto&& change) {
    Stimulus stimulus = ball();
    change(stimulus);
    const auto points = stimulated_points(kRow, {}, stimulus, "physics.stimuli[0]");
    return points.ok() ? std::string("none") : points.error().message;
  };
  EXPECT_EQ(error_of([](Stimulus& s) { s.start_ms = -1; }),
            "physics.stimuli[0].start_ms: found -1, expected a finite number of at least 0 ms");
  EXPECT_EQ(error_of([](Stimulus& s) { s.duration_ms = 0; }),
            "physics.stimuli[0].duration_ms: found 0, expected more than 0 ms");
  EXPECT_EQ(error_of([](Stimulus& s) { s.strength_per_ms = std::numeric_limits<double>::infinity(); }),
            "physics.stimuli[0].strength_per_ms: found inf, expected a finite number > 0 1/ms");
  EXPECT_EQ(error_of([](Stimulus& s) { s.count = 0; }),
            "physics.stimuli[0].count: found 0, expected at least 1");
}

TEST(Stimulus, StartsAtItsBeatsAndThenItsExtraBeats) {
  Stimulus stimulus;
  stimulus.start_ms = 10;
  EXPECT_EQ(start_times_ms(stimulus), (std::vector<double>{10}));
  stimulus.count = 3;
  stimulus.s3_ms = 250;
  EXPECT_EQ(start_times_ms(stimulus), (std::vector<double>{10, 610, 1210, 1460}));
  stimulus.s2_ms = 300;
  EXPECT_EQ(start_times_ms(stimulus), (std::vector<double>{10, 610, 1210, 1510, 1760}));
}

TEST(EikonalSources, AreThePointsOfEachStimulusAtItsFirstStart) {
  const Result<Tissue> tissue = make_tissue(kMesh, {}, {TissueBy::kMesh, {kind({3})}});
  ASSERT_TRUE(tissue.ok()) << tissue.error().message;  // the last tetrahedron, of points 4 to 7
  Stimulus first = ball(), second = ball();
  first.centre_mm = kMesh.points[7];
  first.start_ms = 5;
  first.count = 2;
  second.centre_mm = {4, 0, 0};
  second.radius_mm = 0.5;
  const auto sources = eikonal_sources(kMesh, *tissue, {first, second});
  ASSERT_TRUE(sources.ok()) << sources.error().message;
  std::vector<std::uint32_t> points;
  std::vector<double> times;
  for (const EikonalSource& source : *sources) {
    points.push_back(source.point);
    times.push_back(source.time_ms);
  }
  EXPECT_EQ(points, (std::vector<std::uint32_t>{6, 7, 4}));
  EXPECT_EQ(times, (std::vector<double>{5, 5, 0}));
}

TEST(EikonalSources, NeedAStimulusOnTissue) {
  const Result<Tissue> tissue = make_tissue(kMesh, {}, {TissueBy::kMesh, {kind({3})}});
  ASSERT_TRUE(tissue.ok());
  const auto none = eikonal_sources(kMesh, *tissue, {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kUsage);
  EXPECT_EQ(none.error().message,
            "physics.stimuli: found none, expected at least one, where the wave starts");
  // Point 0 is of the mesh, but of no tissue.
  Stimulus far = ball();
  const auto away = eikonal_sources(kMesh, *tissue, {far});
  ASSERT_FALSE(away.ok());
  EXPECT_EQ(away.error().message.find("physics.stimuli[0]: found no point of conducting tissue"), 0U)
      << away.error().message;
}

}  // namespace
}  // namespace voxtet
