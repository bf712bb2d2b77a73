#include "physics/ventricles/ventricular_potentials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/check_tets.h"
#include "support/heart_fibres.h"

namespace voxtet {
namespace {

using test::potentials_of;

/// The root of the mean square error of the potential at the points of half a shell from 6 to 12 mm, through
/// whose base nothing flows.
double error_in_half_a_shell(std::uint32_t layers, std::uint32_t rings) {
  const test::HeartBody body = test::left_ventricle(layers, rings, {6, 12, 6, 12, 0});
  const VentricularPotentials potentials = potentials_of(body);
  double squares = 0;
  for (std::uint32_t i = 0; i < body.mesh.points.size(); ++i) {
    const double exact = (1 / body.mesh.points[i].norm() - 1 / 12.0) / (1 / 6.0 - 1 / 12.0);
    const double error = potentials.lv[i] - exact;
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(body.mesh.points.size()));
}

TEST(VentricularPotentials, AreOneOverRadiusInAShell) {
  const double coarse = error_in_half_a_shell(2, 4), middle = error_in_half_a_shell(4, 8),
               fine = error_in_half_a_shell(8, 16);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.2) << coarse << ' ' << middle << ' ' << fine;
}

TEST(VentricularPotentials, TestBodiesAreMeshes) {
  test::check_tets(test::left_ventricle(2, 5).mesh);
  const test::HeartBody body = test::two_ventricles(2, 10);
  test::check_tets(body.mesh);
  for (const HeartSurface surface :
       {HeartSurface::kBase, HeartSurface::kEpicardium, HeartSurface::kLvEndocardium,
        HeartSurface::kRvEndocardium, HeartSurface::kRvSeptum})
    EXPECT_GT(std::count(body.surfaces.faces.begin(), body.surfaces.faces.end(), surface), 20);
  EXPECT_EQ(std::count(body.surfaces.faces.begin(), body.surfaces.faces.end(), HeartSurface::kNone), 0);
}

TEST(VentricularPotentials, TakeTheirValuesOnTheSurfaces) {
  const test::HeartBody body = test::two_ventricles(2, 12);
  const VentricularPotentials p = potentials_of(body);
  const auto expect = [&](HeartSurface surface, double epi, double lv, double rv) {
    std::vector<bool> elsewhere(body.mesh.points.size(), false), here = elsewhere;
    for (std::size_t f = 0; f < body.mesh.faces.size(); ++f)
      for (const std::uint32_t i : body.mesh.faces[f])
        (body.surfaces.faces[f] == surface ? here : elsewhere)[i] = true;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < here.size(); ++i) {
      if (!here[i] || elsewhere[i]) continue;
      ++count;
      EXPECT_NEAR(p.epi[i], epi, 1e-12);
      EXPECT_EQ(p.lv[i], lv);
      EXPECT_EQ(p.rv[i], rv);
    }
    EXPECT_GT(count, 20U);
  };
  expect(HeartSurface::kEpicardium, 1, 0, 0);
  expect(HeartSurface::kLvEndocardium, 0, 1, 0);
  expect(HeartSurface::kRvEndocardium, 0, 0, 1);
  expect(HeartSurface::kRvSeptum, 0, 0, 1);
  EXPECT_EQ(p.base[body.surfaces.apex], 0);
  for (std::uint32_t i = 0; i < body.mesh.points.size(); ++i)
    if (body.part[i] == 1) {
      EXPECT_EQ(p.base[i], 1);
    }
}

TEST(VentricularPotentials, TellTheFreeWallFromTheSeptum) {
  const test::HeartBody body = test::two_ventricles(2, 16);
  const VentricularPotentials p = potentials_of(body);
  std::vector<HeartSurface> at(body.mesh.points.size(), HeartSurface::kNone);
  for (const HeartSurface surface :
       {HeartSurface::kRvEndocardium, HeartSurface::kLvEndocardium, HeartSurface::kRvSeptum})
    for (std::size_t f = 0; f < body.mesh.faces.size(); ++f)
      if (body.surfaces.faces[f] == surface)
        for (const std::uint32_t i : body.mesh.faces[f]) at[i] = surface;
  std::size_t right = 0, left = 0, different = 0;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    const auto points_at = [&](HeartSurface surface) {
      return std::count_if(body.mesh.tets[t].begin(), body.mesh.tets[t].end(),
                           [&](auto i) { return at[i] == surface; });
    };
    const bool is = is_right(body.mesh, p, t);
    different += is != body.free_wall[t];
    if (points_at(HeartSurface::kRvEndocardium) == 3) {
      ++right;
      EXPECT_TRUE(is);
    } else if (points_at(HeartSurface::kLvEndocardium) + points_at(HeartSurface::kRvSeptum) >= 3 ||
               body.centroid(t).x() < 0) {
      ++left;
      EXPECT_FALSE(is);
    }
  }
  EXPECT_GT(right, 300U);
  EXPECT_GT(left, 3000U);
  // Only where the free wall rests on the left ventricle.
  EXPECT_LT(static_cast<double>(different), 0.01 * static_cast<double>(body.mesh.tets.size()));
}

TEST(VentricularPotentials, LeaveOutWhatIsNotOfTheWall) {
  const test::HeartBody body = test::left_ventricle(2, 6);
  const VentricularPotentials alone = potentials_of(body);
  test::HeartBody with = body;
  const Triangle& face = body.mesh.faces[0];
  with.mesh.points.emplace_back(100, 100, 100);
  with.mesh.tets.push_back({face[0], face[1], face[2], static_cast<std::uint32_t>(body.mesh.points.size())});
  if (test::tet_volume(with.mesh, static_cast<std::uint32_t>(body.mesh.tets.size())) < 0)
    std::swap(with.mesh.tets.back()[0], with.mesh.tets.back()[1]);
  with.mesh.labels.push_back(2);
  with.surfaces.wall.push_back(false);
  const VentricularPotentials p = potentials_of(with);
  const Eigen::Index count = alone.lv.size();
  for (const auto member :
       {&VentricularPotentials::lv, &VentricularPotentials::epi, &VentricularPotentials::rv,
        &VentricularPotentials::base, &VentricularPotentials::free_wall}) {
    EXPECT_EQ((p.*member).head(count), alone.*member);
    EXPECT_TRUE(std::isnan((p.*member)[count]));
  }
}

TEST(VentricularPotentials, StopWhenCancelled) {
  const test::HeartBody body = test::left_ventricle(2, 12);
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const auto potentials = ventricular_potentials(body.mesh, body.surfaces, ctx);
  ASSERT_FALSE(potentials.ok());
  EXPECT_EQ(potentials.error().code, ErrorCode::kCancelled);
}

TEST(VentricularPotentials, NameTheSurfaceThatIsMissing) {
  const test::HeartBody whole = test::two_ventricles(1, 8);
  const auto message = [](const test::HeartBody& body) {
    const auto potentials = ventricular_potentials(body.mesh, body.surfaces, {});
    if (potentials.ok()) return std::string("none");
    EXPECT_EQ(potentials.error().code, ErrorCode::kUsage);
    return potentials.error().message;
  };
  const auto without = [&](HeartSurface surface) {
    test::HeartBody body = whole;
    std::replace(body.surfaces.faces.begin(), body.surfaces.faces.end(), surface, HeartSurface::kNone);
    return message(body);
  };
  const std::string found = ": found no face at the wall, expected at least one";
  EXPECT_EQ(without(HeartSurface::kBase), "heart_surfaces.base" + found);
  EXPECT_EQ(without(HeartSurface::kEpicardium), "heart_surfaces.epicardium" + found);
  EXPECT_EQ(without(HeartSurface::kLvEndocardium), "heart_surfaces.lv_endocardium" + found);
  EXPECT_EQ(without(HeartSurface::kRvEndocardium), "heart_surfaces.rv_endocardium" + found);
  EXPECT_EQ(without(HeartSurface::kRvSeptum), "heart_surfaces.rv_septum" + found);

  test::HeartBody body = whole;
  body.surfaces.apex = 1'000'000;
  EXPECT_EQ(message(body), "heart_surfaces.apex: found point 1000000, expected a point of the wall");
  for (std::uint32_t i = 0; i < body.part.size(); ++i)
    if (body.part[i] == 1) body.surfaces.apex = i;
  EXPECT_NE(message(body).find("of the base, expected one far from it"), std::string::npos) << message(body);
  body = whole;
  body.surfaces.wall.assign(body.mesh.tets.size(), false);
  EXPECT_EQ(message(body), "heart_surfaces.wall: found no tetrahedron of the wall, expected at least one");
  body.surfaces.wall.pop_back();
  EXPECT_NE(message(body).find("heart_surfaces.wall: found "), std::string::npos);
  body = whole;
  body.surfaces.faces.pop_back();
  EXPECT_NE(message(body).find("heart_surfaces.faces: found "), std::string::npos);
}

}  // namespace
}  // namespace voxtet
