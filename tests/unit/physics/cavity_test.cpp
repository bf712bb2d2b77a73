#include "physics/cavities/cavity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>

#include "base/digest.h"
#include "physics/cavities/enclosure.h"
#include "support/ellipsoid.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

struct OpenSurface {
  Points points;
  std::vector<Triangle> triangles;
};

/// A prism over a regular polygon, open at both ends or closed by one more point at the lower one.
OpenSurface tube(std::uint32_t sides, double radius, double length, bool closed_below) {
  OpenSurface surface;
  for (const double z : {0.0, length})
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * EIGEN_PI * i / sides;
      surface.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    surface.triangles.push_back({i, j, sides + j});
    surface.triangles.push_back({i, sides + j, sides + i});
    if (closed_below) surface.triangles.push_back({j, i, 2 * sides});
  }
  if (closed_below) surface.points.emplace_back(0, 0, 0);
  return surface;
}

double prism_mm3(std::uint32_t sides, double radius, double length) {
  return sides / 2.0 * radius * radius * std::sin(2 * EIGEN_PI / sides) * length;
}

Cavity closed(const OpenSurface& surface) {
  auto cavity = close_cavity(surface.points, surface.triangles, "test");
  EXPECT_TRUE(cavity.ok()) << (cavity.ok() ? "" : cavity.error().message);
  return *std::move(cavity);
}

Cavity cavity_of(const test::HeartBody& body, Ventricle ventricle) {
  auto cavity = ventricle_cavity(body.mesh, body.surfaces, ventricle);
  EXPECT_TRUE(cavity.ok()) << (cavity.ok() ? "" : cavity.error().message);
  return *std::move(cavity);
}

Eigen::VectorXd numbers(const Points& points) {
  return mechanics::Nodes(points).places_after({});
}

Points triples(const Eigen::VectorXd& numbers) {
  Points out;
  for (Eigen::Index i = 0; i < numbers.size(); i += 3) out.emplace_back(numbers.segment<3>(i));
  return out;
}

Points gradient_of(const Cavity& cavity, const Points& points) {
  const Eigen::VectorXd x = numbers(points);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
  Enclosure(mechanics::Nodes(points), cavity).add_gradient(x, 1, gradient);
  return triples(gradient);
}

/// Twice the change of the gradient.
Points change_of(const Cavity& cavity, const Points& points, const Points& moves) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(points.size()));
  Enclosure(mechanics::Nodes(points), cavity).add_gradient_change(numbers(points), numbers(moves), 2, change);
  return triples(change);
}

/// Smooth moves that are no motion of the whole.
Points moves_of(const Points& points) {
  Points moves;
  for (const Eigen::Vector3d& p : points)
    moves.emplace_back(std::sin(p.y()) + 0.1 * p.x(), std::cos(p.z() / 2),
                       std::sin(p.x() + p.z()) - 0.2 * p.y());
  return moves;
}

Points moved(Points points, const Points& moves, double factor) {
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += factor * moves[i];
  return points;
}

double dot(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

TEST(Cavity, OfAPrismHasItsVolume) {
  for (const bool closed_below : {true, false}) {
    const OpenSurface surface = tube(7, 5, 12, closed_below);
    const Cavity cavity = closed(surface);
    EXPECT_EQ(cavity.rims.size(), closed_below ? 1U : 2U);
    for (const auto& rim : cavity.rims) EXPECT_EQ(rim.size(), 7U);
    EXPECT_NEAR(volume_mm3(cavity, surface.points), prism_mm3(7, 5, 12), 1e-10);
  }
}

TEST(Cavity, OfHalfABallConvergesToItsVolume) {
  const double exact = 2.0 / 3 * EIGEN_PI * 216;
  std::vector<double> errors;
  for (const std::uint32_t rings : {8U, 16U, 32U}) {
    const test::HeartBody body = test::left_ventricle(1, rings, {6, 12, 6, 12, 0});
    errors.push_back(exact - volume_mm3(cavity_of(body, Ventricle::kLeft), body.mesh.points));
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.1);
  EXPECT_LT(errors[2], 2e-3 * exact);
}

TEST(Cavity, OfATruncatedEllipsoidHasItsVolume) {
  // x^2 + y^2 = 49 (1 - z^2 / 289) from -17 to 5.
  const auto primitive = [](double z) { return EIGEN_PI * 49 * (z - z * z * z / (3 * 289)); };
  const double exact = primitive(5) - primitive(-17);
  const test::HeartBody body = test::left_ventricle(1, 32);
  EXPECT_NEAR(volume_mm3(cavity_of(body, Ventricle::kLeft), body.mesh.points), exact, 3e-3 * exact);
}

TEST(Cavity, DoesNotDependOnHowTrianglesAreOriented) {
  OpenSurface surface = tube(9, 4, 7, true);
  const double volume = volume_mm3(closed(surface), surface.points);
  for (std::size_t t = 0; t < surface.triangles.size(); t += 2)
    std::swap(surface.triangles[t][0], surface.triangles[t][2]);
  EXPECT_NEAR(volume_mm3(closed(surface), surface.points), volume, 1e-10);
  for (Triangle& triangle : surface.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(volume_mm3(closed(surface), surface.points), volume, 1e-10);
}

TEST(Cavity, DoesNotChangeAsTheWholeMoves) {
  const OpenSurface surface = tube(9, 4, 7, false);
  const Cavity cavity = closed(surface);
  const double volume = volume_mm3(cavity, surface.points);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  Points far = surface.points;
  for (Eigen::Vector3d& p : far) p = turn * p + Eigen::Vector3d(300, -4000, 77);
  EXPECT_NEAR(volume_mm3(cavity, far), volume, 1e-8);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
  const Points gradient = gradient_of(cavity, surface.points);
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    force += gradient[i];
    torque += surface.points[i].cross(gradient[i]);
  }
  EXPECT_LT(force.norm(), 1e-12 * volume);
  EXPECT_LT(torque.norm(), 1e-12 * volume);
}

void expect_gradient_of_differences(const Cavity& cavity, Points points) {
  const Points gradient = gradient_of(cavity, points);
  double scale = 0;
  for (const Eigen::Vector3d& g : gradient) scale = std::max(scale, g.norm());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-4;
      const double at = points[i][axis];
      points[i][axis] = at + kStep;
      const double more = volume_mm3(cavity, points);
      points[i][axis] = at - kStep;
      const double less = volume_mm3(cavity, points);
      points[i][axis] = at;
      EXPECT_NEAR(gradient[i][axis], (more - less) / (2 * kStep), 1e-6 * scale) << i << ' ' << axis;
    }
}

TEST(Cavity, GradientIsThatOfDifferences) {
  const test::HeartBody body = test::left_ventricle(1, 6);
  expect_gradient_of_differences(cavity_of(body, Ventricle::kLeft), body.mesh.points);
  const OpenSurface surface = tube(8, 5, 9, false);
  expect_gradient_of_differences(closed(surface), surface.points);
}

TEST(Cavity, ChangeOfTheGradientIsThatOfDifferences) {
  for (const bool closed_below : {true, false}) {
    const OpenSurface surface = tube(8, 5, 9, closed_below);
    const Cavity cavity = closed(surface);
    const Points moves = moves_of(surface.points);
    const Points change = change_of(cavity, surface.points, moves);
    constexpr double kStep = 1e-4;
    const Points more = gradient_of(cavity, moved(surface.points, moves, kStep)),
                 less = gradient_of(cavity, moved(surface.points, moves, -kStep));
    for (std::size_t i = 0; i < moves.size(); ++i)
      EXPECT_LT((change[i] / 2 - (more[i] - less[i]) / (2 * kStep)).norm(), 1e-6) << i;
    // Symmetric, as second derivatives are.
    const Points others = moves_of(moves);
    const Points other_change = change_of(cavity, surface.points, others);
    EXPECT_NEAR(dot(others, change), dot(moves, other_change), 1e-10 * std::abs(dot(others, change)));
  }
}

TEST(Cavity, OfQuadraticElementsChangesAsItsGradientSays) {
  const test::HeartBody body = test::left_ventricle(1, 6);
  const Cavity cavity = cavity_of(body, Ventricle::kLeft);
  const mechanics::Nodes nodes(body.mesh, mechanics::Formulation::kQuadratic);
  const Enclosure enclosure(nodes, cavity);
  const Eigen::VectorXd rest = nodes.places_after({});
  EXPECT_NEAR(enclosure.volume_mm3(rest), volume_mm3(cavity, body.mesh.points), 1e-9);
  // Curved by moves that the corners do not have.
  const Eigen::VectorXd moves = numbers(moves_of(triples(rest))), x = rest + 0.1 * moves,
                        others = numbers(moves_of(triples(moves)));
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size()), change = gradient, more = gradient,
                  less = gradient;
  enclosure.add_gradient(x, 1, gradient);
  enclosure.add_gradient_change(x, others, 1, change);
  constexpr double kStep = 1e-4;
  const Eigen::VectorXd step = kStep * others;
  EXPECT_NEAR(gradient.dot(others),
              (enclosure.volume_mm3(x + step) - enclosure.volume_mm3(x - step)) / (2 * kStep),
              1e-6 * std::abs(gradient.dot(others)));
  enclosure.add_gradient(x + step, 1, more);
  enclosure.add_gradient(x - step, 1, less);
  EXPECT_LT((change - (more - less) / (2 * kStep)).norm(), 1e-6 * change.norm());
}

TEST(Cavity, PressesOutwards) {
  const test::HeartBody body = test::left_ventricle(1, 8);
  const Points gradient = gradient_of(cavity_of(body, Ventricle::kLeft), body.mesh.points);
  for (std::size_t i = 0; i < gradient.size(); ++i)
    if (body.part[i] < 0.9 && body.depth[i] == 0) {
      EXPECT_GT(gradient[i].dot(body.mesh.points[i]), 0) << i;
    }
}

/// The error of a surface that cannot be closed.
Error error_of(const OpenSurface& surface) {
  const auto cavity = close_cavity(surface.points, surface.triangles, "lv_endocardium");
  EXPECT_FALSE(cavity.ok());
  if (cavity.ok()) return {};
  EXPECT_EQ(cavity.error().code, ErrorCode::kMeshing);
  return cavity.error();
}

TEST(Cavity, WithoutTrianglesIsNone) {
  EXPECT_EQ(error_of({}).message,
            "cavity lv_endocardium: found no triangle, expected a surface around the cavity");
}

TEST(Cavity, InPiecesIsNone) {
  OpenSurface surface = tube(6, 2, 3, true);
  const auto first = static_cast<std::uint32_t>(surface.points.size());
  for (const Eigen::Vector3d& p : tube(6, 2, 3, true).points)
    surface.points.push_back(p + Eigen::Vector3d(9, 0, 0));
  for (const auto& [a, b, c] : tube(6, 2, 3, true).triangles)
    surface.triangles.push_back({a + first, b + first, c + first});
  const Error error = error_of(surface);
  EXPECT_NE(error.message.find("18 of 36 triangles apart from the others"), std::string::npos)
      << error.message;
  ASSERT_EQ(error.where.points.size(), 3U);
  EXPECT_GT(error.where.points[0].x(), 5);
}

TEST(Cavity, WithoutARimIsNone) {
  OpenSurface surface = tube(6, 2, 3, true);
  surface.points.emplace_back(0, 0, 3);
  for (std::uint32_t i = 0; i < 6; ++i) surface.triangles.push_back({6 + i, 6 + (i + 1) % 6, 13});
  const Error error = error_of(surface);
  EXPECT_NE(error.message.find("a surface without a rim"), std::string::npos) << error.message;
  EXPECT_EQ(error.where.points.size(), 3U);
}

TEST(Cavity, WithAnEdgeOfThreeTrianglesIsNone) {
  OpenSurface surface = tube(6, 2, 3, true);
  surface.points.emplace_back(0, 5, 1);
  surface.triangles.push_back({0, 1, 13});
  const Error error = error_of(surface);
  EXPECT_NE(error.message.find("an edge with 3 triangles"), std::string::npos) << error.message;
  ASSERT_EQ(error.where.points.size(), 2U);
  EXPECT_EQ(error.where.points[0], surface.points[0]);
  EXPECT_EQ(error.where.points[1], surface.points[1]);
}

TEST(Cavity, WhoseRimsMeetIsNone) {
  OpenSurface surface = tube(6, 2, 3, true);
  // Without a triangle that has one point of the rim.
  surface.triangles.erase(surface.triangles.begin());
  const Error error = error_of(surface);
  EXPECT_NE(error.message.find("rims that meet in a point"), std::string::npos) << error.message;
  ASSERT_EQ(error.where.points.size(), 1U);
  EXPECT_EQ(error.where.points[0], surface.points[7]);
}

TEST(Cavity, WithOneSideIsNone) {
  // A strip of Moebius.
  OpenSurface surface;
  constexpr std::uint32_t kCount = 12;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * EIGEN_PI * i / kCount;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector3d across = std::cos(angle / 2) * out + std::sin(angle / 2) * Eigen::Vector3d::UnitZ();
    surface.points.push_back(5 * out + across);
    surface.points.push_back(5 * out - across);
  }
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const bool last = i + 1 == kCount;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({b, d, c});
  }
  const Error error = error_of(surface);
  EXPECT_NE(error.message.find("only one side"), std::string::npos) << error.message;
  EXPECT_EQ(error.where.points.size(), 3U);
}

TEST(Cavity, ThatIsFlatIsNone) {
  OpenSurface surface{{{0, 0, 1}, {3, 0, 1}, {0, 3, 1}, {3, 3.3, 1}}, {{0, 1, 2}, {1, 3, 2}}};
  EXPECT_NE(error_of(surface).message.find("a flat surface"), std::string::npos);
}

TEST(Cavity, OfAVentricleThatIsNotThereIsNone) {
  test::HeartBody body = test::left_ventricle(1, 4);
  const auto right = ventricle_cavity(body.mesh, body.surfaces, Ventricle::kRight);
  ASSERT_FALSE(right.ok());
  EXPECT_EQ(right.error().message,
            "cavity rv_endocardium: found no triangle, expected a surface around the cavity");
  body.surfaces.faces.pop_back();
  const auto left = ventricle_cavity(body.mesh, body.surfaces, Ventricle::kLeft);
  ASSERT_FALSE(left.ok());
  EXPECT_EQ(left.error().code, ErrorCode::kInternal);
}

TEST(Cavity, SameBytesOnEveryPlatform) {
  const OpenSurface surface{{{0, 0, 0}, {4, 0.5, 0}, {0.25, 3, 0}, {1, 1, -2}},
                            {{0, 1, 3}, {3, 2, 1}, {0, 2, 3}}};
  const Cavity cavity = closed(surface);
  const double volume = volume_mm3(cavity, surface.points);
  Sha256 sha;
  sha.update_values(&volume, 1);
  for (const Eigen::Vector3d& g : gradient_of(cavity, surface.points)) sha.update_values(g.data(), 3);
  for (const auto& rim : cavity.rims) sha.update_values(rim.data(), rim.size());
  EXPECT_EQ(sha.hex().substr(0, 16), "7846a5a2cb2976e1");
}

}  // namespace
}  // namespace voxtet
