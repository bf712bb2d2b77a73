#include "physics/ventricles/ventricular_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/heart_fibres.h"

namespace voxtet {
namespace {

std::vector<Field> coordinates_of(const test::HeartBody& body) {
  auto fields = ventricular_coordinates(body.mesh, body.surfaces, test::potentials_of(body), {});
  EXPECT_TRUE(fields.ok()) << (fields.ok() ? "" : fields.error().message);
  for (const Field& field : *fields) {
    EXPECT_EQ(field.on, On::kPoints);
    EXPECT_EQ(field.values.size(), body.mesh.points.size());
    EXPECT_TRUE(all_finite(field.values)) << field.name;
  }
  return *std::move(fields);
}

const std::vector<float>& values(const std::vector<Field>& fields, const char* name) {
  return find_field(fields, name)->values;
}

/// The angle about the axis z, from x on; points of the axis have none.
void expect_angle(double found, const Eigen::Vector3d& p, double tolerance) {
  if (p.head<2>().norm() > 1e-3) {
    EXPECT_NEAR(std::remainder(found - std::atan2(p.y(), p.x()), 2 * EIGEN_PI), 0, tolerance);
  }
}

double length_along(const test::Ellipsoid& e, double t, double to) {
  double length = 0;
  for (int i = 0; i < 400; ++i) length += (e.at(t, to * (i + 1) / 400, 0) - e.at(t, to * i / 400, 0)).norm();
  return length;
}

TEST(VentricularCoordinates, AreThoseOfTheEllipsoid) {
  const test::Ellipsoid ellipsoid;
  const test::HeartBody body = test::left_ventricle(4, 20);
  const std::vector<Field> fields = coordinates_of(body);
  double depth = 0, along = 0;
  for (std::size_t i = 0; i < body.mesh.points.size(); ++i) {
    const Eigen::Vector3d& p = body.mesh.points[i];
    const double t = body.depth[i];
    depth = std::max(depth, std::abs(values(fields, "transmural")[i] - t));
    expect_angle(values(fields, "rotational")[i], p, 1e-3);
    EXPECT_EQ(values(fields, "ventricle")[i], 0);
    // On the epicardium, where the apex is.
    if (t != 1) continue;
    const double whole = ellipsoid.along(1, 1);
    const double exact = length_along(ellipsoid, 1, whole * body.part[i]) / length_along(ellipsoid, 1, whole);
    along = std::max(along, std::abs(values(fields, "apicobasal")[i] - exact));
  }
  EXPECT_LT(depth, 0.01);
  EXPECT_LT(along, 0.02);
  EXPECT_EQ(values(fields, "apicobasal")[body.surfaces.apex], 0);
}

TEST(VentricularCoordinates, OfTwoVentricles) {
  const test::HeartBody body = test::two_ventricles(2, 14);
  const std::vector<Field> fields = coordinates_of(body);
  std::size_t right = 0;
  for (std::size_t i = 0; i < body.mesh.points.size(); ++i) {
    const Eigen::Vector3d& p = body.mesh.points[i];
    // The right side of the septum is symmetric about x.
    expect_angle(values(fields, "rotational")[i], p, 1e-3);
    if (body.part[i] == 1) {
      EXPECT_EQ(values(fields, "apicobasal")[i], 1);
    }
    right += values(fields, "ventricle")[i] == 1;
  }
  EXPECT_GT(right, 100U);
  const auto on = [&](HeartSurface surface, float transmural) {
    for (std::size_t f = 0; f < body.mesh.faces.size(); ++f) {
      if (body.surfaces.faces[f] != surface) continue;
      int alike = 0;
      for (const std::uint32_t i : body.mesh.faces[f])
        alike += std::abs(values(fields, "transmural")[i] - transmural) < 1e-6F;
      EXPECT_GT(alike, 0) << f;
    }
  };
  on(HeartSurface::kLvEndocardium, 0);
  on(HeartSurface::kRvEndocardium, 0);
  on(HeartSurface::kRvSeptum, 1);
  on(HeartSurface::kEpicardium, 1);
}

}  // namespace
}  // namespace voxtet
