// Surfaces that are hard to fill, and which of fill_tets' ways each of them takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/digest.h"
#include "support/check_tets.h"
#include "support/nasty_surfaces.h"
#include "tetra/fill/fill_tets.h"
#include "tetra/fill/forecast_points.h"

namespace voxtet {
namespace {

using test::append;
using test::check_tets;
using test::nearly_touching;
using test::needled;
using test::random_cells;
using test::scaled;
using test::specks;
using test::sphere;
using test::turned;
using test::uniform_sizing;

struct Filled {
  Result<TetMesh> mesh;
  std::vector<std::string> notes, warnings;
  std::string last_note() const { return notes.empty() ? "" : notes.back(); }
};

Filled fill_noted(const SurfaceMesh& surface, double edge) {
  Filled out{Error{}, {}, {}};
  RunContext ctx;
  ctx.on_note = [&](const std::string&, const std::string& text) { out.notes.push_back(text); };
  ctx.on_warning = [&](const std::string&, const std::string& text) { out.warnings.push_back(text); };
  FillParams params;
  params.backend = TetBackend::kTetgen;
  params.min_dihedral_deg = 14;  // so that there is something to drop
  out.mesh = fill_tets(surface, uniform_sizing(edge), params, ctx);
  return out;
}

void expect_filled(const SurfaceMesh& surface, double edge, const std::string& way, const std::string& name) {
  const Filled out = fill_noted(surface, edge);
  ASSERT_TRUE(out.mesh.ok()) << name << ": " << out.mesh.error().message;
  check_tets(*out.mesh, surface);
  EXPECT_NE(out.last_note().find("filled " + way + " (strategy"), std::string::npos)
      << name << ": " << out.last_note();
  const bool warned = std::any_of(out.warnings.begin(), out.warnings.end(), [](const std::string& text) {
    return text.find("filled ") == 0 && text.find(", after: ") != std::string::npos;
  });
  EXPECT_EQ(warned, way != "as asked") << name;
}

TEST(Fallback, FillsSheetsFarCloserThanTheirEdgesAsAsked) {
  for (const double gap : {0.05, 0.001}) {
    SurfaceMesh sheets = sphere({0, 0, 0}, 10, 3, 1, 0);
    append(sheets, sphere({0, 0, 0}, 10 - gap, 3, 2, 1));
    expect_filled(sheets, 2, "as asked", "gap " + std::to_string(gap));
  }
}

TEST(Fallback, FillsSharpRimsAsAskedAndSaysHowSharp) {
  // Pressed spheres: dihedral angles at the rim of 2.3 and 0.23 degrees.
  for (const double height : {1e-3, 1e-4}) {
    const SurfaceMesh lens = scaled(sphere({0, 0, 0}, 10, 3, 1, 0), {1, 1, height});
    expect_filled(lens, 1.5, "as asked", "height " + std::to_string(height));
    const Filled out = fill_noted(lens, 1.5);
    ASSERT_EQ(out.warnings.size(), 2U) << "the triangle's angle and the rim's";
    EXPECT_NE(out.warnings[1].find(height == 1e-3 ? "meet at 2.28 degrees" : "meet at 0.23 degrees"),
              std::string::npos)
        << out.warnings[1];
  }
}

TEST(Fallback, FillsNeedlesAndSpikesAsAskedAndNotesTheirAngle) {
  const SurfaceMesh needles = needled(sphere({0, 0, 0}, 10, 3, 1, 0), 300, 0.01, 1);
  expect_filled(needles, 2, "as asked", "needles");
  expect_filled(test::spiked(1e-3, 8, 3, 6, 1), 2, "as asked", "spikes");
  const Filled out = fill_noted(needles, 2);
  EXPECT_EQ(out.notes[0].find("the surface's smallest angles: in a triangle 0."), 0U) << out.notes[0];
  EXPECT_EQ(out.warnings[0].find("a triangle has an angle of 0."), 0U) << out.warnings[0];
}

TEST(Fallback, FillsFarAwayTinyAndHugeSurfacesAsAsked) {
  const SurfaceMesh body = random_cells(5, 3, 0.1, 5);
  expect_filled(scaled(body, {1, 1, 1}, {1e5, -1e5, 1e5}), 1, "as asked", "far");
  expect_filled(scaled(body, {1e-3, 1e-3, 1e-3}), 1e-3, "as asked", "tiny");
  expect_filled(scaled(body, {1e4, 1e4, 1e4}), 1e4, "as asked", "huge");
}

TEST(Fallback, FillsManySpecksDeepNestsAndCoplanarTrianglesAsAsked) {
  expect_filled(specks(10, 0.2, 3), 3, "as asked", "specks");
  expect_filled(test::nested_spheres(10, 0.9), 2, "as asked", "nested");
  expect_filled(random_cells(6, 5, 0, 5), 1, "as asked", "coplanar");
}

TEST(Fallback, FillsAPrismThatCannotBeCutWithoutAPointInside) {
  for (const double turn : {0.3, 0.577, 0.7})
    expect_filled(test::twisted_prism(turn), 5, "as asked", "prism");
}

TEST(Fallback, TakesAFinerToleranceWherePointsAllButCoincide) {
  for (const double gap : {1e-8, 1e-11, 1e-13})
    expect_filled(nearly_touching(gap), 4, "with a finer tolerance", "gap " + std::to_string(gap));
  expect_filled(test::spiked(1e-4, 6, 2, 4, 3), 4, "with a finer tolerance", "spike");
}

TEST(Fallback, DisplacesPointsWhereATetrahedronComesOutFlat) {
  expect_filled(needled(sphere({0, 0, 0}, 10, 2, 1, 0), 100, 0.003, 14), 4,
                "with points displaced by a millionth of their edges", "needles");
}

TEST(Fallback, DropsTheBoundsOnDihedralAnglesWhereTheyTakeTooManyPoints) {
  expect_filled(specks(2, 0.003, 2), 5, "without bounds on dihedral angles", "specks");
}

TEST(Fallback, DropsAllBoundsOnShapesWhereTheyTakeTooManyPoints) {
  const SurfaceMesh surface = specks(2, 1e-4, 2);
  expect_filled(surface, 5, "with bounds on sizes alone", "specks");
  EXPECT_LT(static_cast<double>(fill_noted(surface, 5).mesh->points.size()),
            20 * forecast_points(surface, uniform_sizing(5)));
}

TEST(Fallback, EndsWhereTheMesherWalksInCircles) {
  // A slab a ten-millionth as thick as wide: with the default tolerance TetGen looks for an edge for ever.
  const SurfaceMesh slab = test::cells({5, 5, 3}, 1, [](int, int, int k) { return Label(k == 1 ? 2 : 1); });
  const Filled out = fill_noted(turned(scaled(slab, {1, 1, 1e-7}), 5, 2, 2, 3), 1);
  ASSERT_GE(out.notes.size(), 2U);
  EXPECT_NE(out.notes[1].find("did not come to an end"), std::string::npos) << out.notes[1];
}

TEST(Fallback, NamesTheTrianglesWhereNothingHelps) {
  // Two vertices closer than doubles near them can tell from a point on a line between others.
  const SurfaceMesh surface = nearly_touching(1e-14);
  const Filled out = fill_noted(surface, 4);
  ASSERT_FALSE(out.mesh.ok());
  EXPECT_EQ(out.mesh.error().code, ErrorCode::kMeshing);
  EXPECT_NE(out.mesh.error().message.find("none of 5 strategies"), std::string::npos)
      << out.mesh.error().message;
  const ErrorPlace& where = out.mesh.error().where;
  ASSERT_FALSE(where.elements.empty());
  ASSERT_EQ(where.elements.size(), where.points.size());
  double far = 0;
  for (const Eigen::Vector3d& p : surface.points) far = std::max(far, std::abs(p.x()));
  for (const std::uint32_t t : where.elements) ASSERT_LT(t, surface.triangles.size());
  for (const Eigen::Vector3d& p : where.points) EXPECT_NEAR(p.x(), far / 3, 4) << "not where the two touch";
  EXPECT_EQ(out.notes.size(), 6U) << "the angles, and why each strategy failed";
}

TEST(Fallback, GivesTheSameBytesOnEveryPlatform) {
  const SurfaceMesh surface = needled(sphere({0, 0, 0}, 10, 2, 1, 0), 100, 0.003, 14);
  const Filled first = fill_noted(surface, 4), second = fill_noted(surface, 4);
  ASSERT_TRUE(first.mesh.ok() && second.mesh.ok());
  EXPECT_EQ(first.mesh->points, second.mesh->points);
  EXPECT_EQ(first.mesh->tets, second.mesh->tets);
  EXPECT_EQ(digest_of(*first.mesh), "732281a13b5d3103f6e2d2d74120c6cf2c10c8f95e7011d114b74e212e707bcc")
      << "another platform, another mesh";
}

TEST(Fallback, EndsOnRandomNastySurfacesWithAMeshOrTheTriangles) {
  int filled = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (const double width : {0.01, 0.001}) {
      const SurfaceMesh surface = needled(turned(random_cells(3, 3, 0.1, seed), 5, 1, 2, 3), 60, width, seed);
      const Filled out = fill_noted(surface, 1);
      if (out.mesh.ok()) {
        check_tets(*out.mesh, surface);
        ++filled;
      } else {
        EXPECT_EQ(out.mesh.error().code, ErrorCode::kMeshing);
        EXPECT_FALSE(out.mesh.error().where.elements.empty()) << out.mesh.error().message;
      }
    }
  EXPECT_GT(filled, 20);
}

TEST(ForecastPoints, IsWithinAFactorOfThePointsThatUniformAndGradedMeshesGet) {
  const SurfaceMesh ball = sphere({0, 0, 0}, 10, 3, 1, 0);
  const SizingField graded = test::sampled_sizing(
      {-11, -11, -11}, {11, 11, 11}, 0.75, [](const auto& x) { return std::min(1.5, 0.5 + 0.2 * x.norm()); });
  RunContext ctx;
  for (const SizingField& sizing : {uniform_sizing(1), uniform_sizing(2), graded}) {
    const auto mesh = fill_tets(ball, sizing, {TetBackend::kTetgen}, ctx);
    ASSERT_TRUE(mesh.ok());
    const double ratio = forecast_points(ball, sizing) / static_cast<double>(mesh->points.size());
    EXPECT_GT(ratio, 0.5);
    EXPECT_LT(ratio, 1.5);
  }
}

TEST(ForecastPoints, StaysWithinTheBoundsOfTheSizesForAShell) {
  SurfaceMesh shell = sphere({0, 0, 0}, 10, 3, 1, 0);
  append(shell, sphere({0, 0, 0}, 8, 3, 0, 1));
  const double volume = 4.18879 * (1000 - 512);
  const double points = forecast_points(shell, uniform_sizing(1)) - static_cast<double>(shell.points.size());
  EXPECT_NEAR(points / (volume / 0.096 / 5.5), 1, 0.02);
}

}  // namespace
}  // namespace voxtet
