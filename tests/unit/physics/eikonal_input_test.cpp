#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "physics/eikonal/solve_eikonal.h"
#include "support/slab_wall.h"
#include "support/uniform_tissue.h"

namespace voxtet {
namespace {

/// The error of a case that is refused; its code is asserted.
Error eikonal_refusal(const TetMesh& mesh, const Tissue& tissue, const std::vector<EikonalSource>& sources,
                      ErrorCode code = ErrorCode::kUsage) {
  RunContext ctx;
  const auto times = solve_eikonal(mesh, tissue, sources, ctx);
  EXPECT_FALSE(times.ok());
  if (times.ok()) return {};
  EXPECT_EQ(times.error().code, code);
  EXPECT_EQ(times.error().stage, "eikonal");
  return times.error();
}

TEST(EikonalInput, NamesTheSourceThatItCannotUse) {
  const TetMesh mesh = test::slab(4, 2);
  Tissue tissue = test::isotropic_tissue(mesh, 0.5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (test::centroid(mesh, mesh.tets[t])[0] > 10) tissue.kind[t] = Tissue::kNone;
  const std::uint32_t inside = test::nearest_point(mesh, {0, 0, 0}),
                      outside = test::nearest_point(mesh, {20, 0, 0});
  EXPECT_EQ(eikonal_refusal(mesh, tissue, {}).message,
            "physics.eikonal.sources: found none, expected at least one");
  EXPECT_EQ(eikonal_refusal(mesh, tissue, {{inside, 0}, {75, 0}}).message,
            "physics.eikonal.sources[1].point: found 75, expected less than 75, the number of points of the "
            "mesh");
  EXPECT_EQ(eikonal_refusal(mesh, tissue, {{inside, 0}, {outside, 0}}).message,
            "physics.eikonal.sources[1].point: found 4, which touches no tetrahedron that conducts, expected "
            "one that does");
  EXPECT_EQ(eikonal_refusal(mesh, tissue, {{inside, std::numeric_limits<double>::infinity()}}).message,
            "physics.eikonal.sources[0].time_ms: found inf, expected a finite number");
}

TEST(EikonalInput, NamesTheTissueThatItCannotUse) {
  const TetMesh mesh = test::slab(4, 2);
  const auto with = [&](const auto& change) {
    Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, Eigen::Vector3d::UnitX());
    tissue.share.assign(mesh.tets.size(), 1);
    change(tissue);
    return eikonal_refusal(mesh, tissue, {{0, 0}});
  };
  EXPECT_EQ(with([](Tissue& t) { t.kind.assign(t.kind.size(), Tissue::kNone); }).message,
            "physics.tissue.kind: found no tetrahedron that conducts, expected at least one");
  EXPECT_EQ(with([](Tissue& t) {
              t.kinds.push_back({0, 0.2, {}});
            }).message,
            "physics.tissue.kinds[1].along_mm_per_ms: found 0, expected a finite number > 0 mm/ms");
  EXPECT_EQ(with([](Tissue& t) { t.kinds[0].across_mm_per_ms = std::nan(""); }).message,
            "physics.tissue.kinds[0].across_mm_per_ms: found nan, expected a finite number > 0 mm/ms");
  EXPECT_EQ(with([](Tissue& t) { t.share[7] = 0; }).message,
            "physics.tissue.share of tetrahedron 7: found 0, expected more than 0, at most 1");
  const Error error = with([](Tissue& t) { t.fibre[9].setZero(); });
  EXPECT_EQ(error.message, "physics.tissue.fibre of tetrahedron 9: found a length of 0, expected 1");
  EXPECT_EQ(error.where.elements, std::vector<std::uint32_t>{9});
}

TEST(EikonalInput, ReadsSharesAndFibresOnlyWhereTheyMatter) {
  const TetMesh mesh = test::slab(4, 2);
  Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, Eigen::Vector3d::UnitX());
  tissue.kinds.push_back({0.5, 0.5, {}});
  tissue.share.assign(mesh.tets.size(), 1);
  tissue.kind[7] = Tissue::kNone;
  tissue.share[7] = 0;
  tissue.fibre[7].setZero();
  tissue.kind[9] = 1;
  tissue.fibre[9].setZero();
  const EikonalSource source{0, 0};
  RunContext ctx;
  EXPECT_TRUE(solve_eikonal(mesh, tissue, {&source, 1}, ctx).ok());
}

TEST(EikonalInput, RefusesListsThatDoNotFitTheMesh) {
  const TetMesh mesh = test::slab(4, 2);
  const auto with = [&](const auto& change) {
    Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, Eigen::Vector3d::UnitX());
    change(tissue);
    return eikonal_refusal(mesh, tissue, {{0, 0}}, ErrorCode::kInternal).message;
  };
  EXPECT_EQ(with([](Tissue& t) { t.kind.pop_back(); }),
            "physics.tissue.kind: found 191 entries, expected one for each of 192 tetrahedra");
  EXPECT_EQ(with([](Tissue& t) { t.share.push_back(1); }),
            "physics.tissue.share: found 1 entries, expected one for each of 192 tetrahedra");
  EXPECT_EQ(with([](Tissue& t) { t.fibre.pop_back(); }),
            "physics.tissue.fibre: found 191 entries, expected one for each of 192 tetrahedra");
  EXPECT_EQ(with([](Tissue& t) { t.kind[3] = 1; }),
            "physics.tissue.kind of tetrahedron 3: found 1, expected less than the number of kinds, 1");
}

}  // namespace
}  // namespace voxtet
