#include "physics/diffusion/diffusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "base/digest.h"
#include "physics/fem/assemble.h"
#include "support/labelled_mesh.h"
#include "support/slab_wall.h"

namespace voxtet {
namespace {

/// The slab of tests/support/slab_wall.h: 1 below `kHeldHeight`, 2 above.
constexpr double kHeldHeight = test::kSlabThickness / 4;

TetMesh two_layers(int nx, int layers) {
  TetMesh mesh = test::slab(nx, layers);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double height = 0;
    for (const std::uint32_t point : mesh.tets[t]) height += mesh.points[point][2] / 4;
    mesh.labels[t] = height < kHeldHeight ? 1 : 2;
  }
  return mesh;
}

Diffusion started(const TetMesh& mesh, const DiffusionParams& params) {
  auto diffusion = Diffusion::start(std::make_shared<const TetMesh>(mesh), params);
  EXPECT_TRUE(diffusion.ok()) << (diffusion.ok() ? "" : diffusion.error().message);
  return *std::move(diffusion);
}

/// By one step, in parts of so many iterations; how many parts it took.
int advance(Diffusion& diffusion, int iterations = std::numeric_limits<int>::max()) {
  for (int parts = 1;; ++parts) {
    const Result<bool> advanced = diffusion.advance(iterations);
    EXPECT_TRUE(advanced.ok()) << (advanced.ok() ? "" : advanced.error().message);
    if (!advanced.ok() || *advanced) return parts;
  }
}

Eigen::VectorXd values_of(const Field& field) {
  return Eigen::VectorXf::Map(field.values.data(), static_cast<Eigen::Index>(field.values.size()))
      .cast<double>();
}

/// A slab from 0 to `length`, held at 1 at z = 0 and insulated at its other end: the series of Carslaw and
/// Jaeger, "Conduction of Heat in Solids" (1959), section 3.4.
double slab_temperature(double z, double length, double diffusivity, double time) {
  const double pi = std::acos(-1);
  double u = 1;
  for (int k = 0; k < 40; ++k) {
    const double wave = (2 * k + 1) * pi / (2 * length);
    u -= 2 / (wave * length) * std::sin(wave * z) * std::exp(-diffusivity * wave * wave * time);
  }
  return u;
}

/// The error in L2 after 3 ms, relative to the root of the volume, with n bricks along each edge of the slab.
/// The error of the step is of first order: steps go with the square of the edge.
double slab_error(int n) {
  const DiffusionParams params{1, 2, 3, 12.8 / (n * n), 1};
  const TetMesh mesh = two_layers(n, n);
  Diffusion diffusion = started(mesh, params);
  while (!diffusion.done()) advance(diffusion);
  const Field field = diffusion.temperature();
  const Eigen::VectorXd mass = fem::assemble_lumped_mass(mesh).value();
  double squares = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double z = std::max(0.0, mesh.points[i][2] - kHeldHeight);
    const double error = field.values[i] - slab_temperature(z, test::kSlabThickness - kHeldHeight,
                                                            params.diffusivity_mm2_per_ms, params.end_ms);
    squares += mass[static_cast<Eigen::Index>(i)] * error * error;
  }
  return std::sqrt(squares / mass.sum());
}

TEST(Diffusion, ErrorInASlabFallsWithTheSquareOfTheEdge) {
  const double coarse = slab_error(8), middle = slab_error(16), fine = slab_error(24);
  EXPECT_LT(fine, 7e-4);
  EXPECT_NEAR(std::log(coarse / middle) / std::log(16 / 8.0), 2, 0.1);
  EXPECT_NEAR(std::log(middle / fine) / std::log(24 / 16.0), 2, 0.1);
}

/// The least and the greatest value in ten steps of `ratio` times h^2 / D, in bricks about h = 0.75 mm wide.
std::array<double, 2> range_of_ten_steps(double ratio) {
  const double step_ms = ratio * 0.75 * 0.75;
  Diffusion diffusion = started(two_layers(26, 8), {1, 1, 10 * step_ms, step_ms, step_ms});
  std::array<double, 2> range{1, 0};
  while (!diffusion.done()) {
    advance(diffusion);
    const Eigen::VectorXd u = values_of(diffusion.temperature());
    range = {std::min(range[0], u.minCoeff()), std::max(range[1], u.maxCoeff())};
  }
  return range;
}

TEST(Diffusion, StepsThatAreNotShortKeepTheMaximumPrinciple) {
  for (const double ratio : {1.0, 10.0}) {
    const auto [least, greatest] = range_of_ten_steps(ratio);
    EXPECT_GE(least, -1e-8) << ratio;
    EXPECT_LE(greatest, 1 + 1e-8) << ratio;
  }
}

TEST(Diffusion, ShortStepsFallALittleBelowZeroAsTheConsistentMassDoes) {
  const auto [least, greatest] = range_of_ten_steps(0.01);
  EXPECT_LT(least, -0.01);
  EXPECT_GT(least, -0.06);
  EXPECT_LE(greatest, 1 + 1e-8);
}

TEST(Diffusion, EnergyDecays) {
  const TetMesh mesh = test::kuhn_cube(5);
  const auto mass = fem::assemble_mass(mesh).value();
  const auto stiffness = fem::assemble_stiffness(mesh, std::vector<double>(mesh.tets.size(), 1.0)).value();
  const auto energy = [](const fem::SparseMatrix& matrix, const Eigen::VectorXd& u) {
    Eigen::VectorXd product;
    fem::multiply(matrix, u, product);
    return fem::dot(u, product);
  };
  Diffusion diffusion = started(mesh, {300, 0.5, 40, 1, 5});
  double before = std::numeric_limits<double>::infinity(), slope_before = before;
  for (; !diffusion.done(); advance(diffusion)) {
    const Eigen::VectorXd u = values_of(diffusion.temperature());
    const double missing = energy(mass, Eigen::VectorXd::Ones(u.size()) - u), slope = energy(stiffness, u);
    EXPECT_LT(missing, before) << "at " << diffusion.time_ms() << " ms";
    EXPECT_LT(slope, slope_before) << "at " << diffusion.time_ms() << " ms";
    before = missing;
    slope_before = slope;
  }
}

TEST(Diffusion, AllIsAsHotAsTheLabelInTheEnd) {
  Diffusion diffusion = started(test::kuhn_cube(4), {7, 10, 10000, 100, 1000});
  while (!diffusion.done()) advance(diffusion);
  EXPECT_NEAR(values_of(diffusion.temperature()).minCoeff(), 1, 1e-6);
}

TEST(Diffusion, StartsWithOneInThePointsOfTheLabel) {
  const TetMesh mesh = test::kuhn_cube(4);
  const Diffusion diffusion = started(mesh, {7, 1, 10, 1, 5});
  const Field field = diffusion.temperature();
  EXPECT_EQ(field.name, "temperature");
  EXPECT_EQ(field.unit, "1");
  EXPECT_EQ(field.on, On::kPoints);
  ASSERT_EQ(field.values.size(), mesh.points.size());
  EXPECT_EQ(std::count(field.values.begin(), field.values.end(), 1.F), 8);
  EXPECT_EQ(std::count(field.values.begin(), field.values.end(), 0.F),
            static_cast<std::ptrdiff_t>(mesh.points.size()) - 8);
}

TEST(Diffusion, FramesAreDueAtZeroAtTheirTimesAndAtTheEnd) {
  // Steps of 0.1 ms add up to no whole number exactly.
  Diffusion diffusion = started(test::kuhn_cube(2), {1, 1, 1.25, 0.1, 0.3});
  std::vector<double> times;
  for (;; advance(diffusion)) {
    if (diffusion.frame_due()) times.push_back(diffusion.time_ms());
    if (diffusion.done()) break;
  }
  // 13 steps of 1.25 / 13 ms, the first of them at or past 0.3, 0.6, 0.9 and 1.2 ms.
  const std::vector<double> expected{0, 4 * 1.25 / 13, 7 * 1.25 / 13, 10 * 1.25 / 13, 1.25};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-12);
  EXPECT_EQ(diffusion.fraction(), 1);

  Diffusion even = started(test::kuhn_cube(2), {1, 1, 0.9, 0.1, 0.3});
  int steps = 0, frames = 0;
  for (; !even.done(); advance(even), ++steps) frames += even.frame_due();
  EXPECT_EQ(steps, 9);
  EXPECT_EQ(frames, 3);
}

TEST(Diffusion, SameBytesOnEveryPlatform) {
  Diffusion diffusion = started(test::kuhn_cube(6), {7, 1.5, 20, 0.7, 5});
  while (!diffusion.done()) advance(diffusion);
  const Field field = diffusion.temperature();
  Sha256 sha;
  sha.update_values(field.values.data(), field.values.size());
  EXPECT_EQ(sha.hex(), "d724e645190c6d494fc547c2695d421b40db50709c0201da654319073c5c649b");
}

TEST(Diffusion, SameBytesHoweverItsStepsAreCut) {
  const DiffusionParams params{7, 1.5, 5, 0.7, 5};
  for (const int iterations : {1, 3}) {
    Diffusion whole = started(test::kuhn_cube(6), params), cut = whole;
    while (!whole.done()) {
      const int parts = whole.time_ms() == 0 ? 4 : 1;
      EXPECT_EQ(advance(whole), parts) << "three parts for the matrices, and one for each step";
      EXPECT_GT(advance(cut, iterations), 2) << "parts of " << iterations << " iterations";
      EXPECT_EQ(cut.temperature().values, whole.temperature().values) << "at " << whole.time_ms() << " ms";
      EXPECT_EQ(cut.time_ms(), whole.time_ms());
    }
    EXPECT_TRUE(cut.done());
  }
}

TEST(Diffusion, AStepUnderWayChangesNothingBeforeItIsComplete) {
  Diffusion diffusion = started(test::kuhn_cube(4), {7, 1, 10, 1, 5});
  const Field before = diffusion.temperature();
  for (int part = 0; part < 4; ++part) {
    const Result<bool> advanced = diffusion.advance(2);
    ASSERT_TRUE(advanced.ok());
    EXPECT_FALSE(*advanced);
  }
  EXPECT_EQ(diffusion.time_ms(), 0);
  EXPECT_EQ(diffusion.temperature().values, before.values);
}

TEST(Diffusion, NamesTheFieldThatIsOutOfRange) {
  const TetMesh mesh = test::kuhn_cube(2);
  const double infinity = std::numeric_limits<double>::infinity();
  const auto message = [&](const DiffusionParams& params) {
    const auto diffusion = Diffusion::start(std::make_shared<const TetMesh>(mesh), params);
    if (diffusion.ok()) return std::string("none");
    EXPECT_EQ(diffusion.error().code, ErrorCode::kUsage);
    return diffusion.error().message;
  };
  EXPECT_EQ(message({1, 0, 1, 1, 1}),
            "physics.diffusion.diffusivity_mm2_per_ms: found 0, expected a finite number > 0 mm^2/ms");
  EXPECT_EQ(message({1, 1, infinity, 1, 1}),
            "physics.diffusion.end_ms: found inf, expected a finite number > 0 ms");
  EXPECT_EQ(message({1, 1, 1, -2, 1}),
            "physics.diffusion.step_ms: found -2, expected a finite number > 0 ms");
  EXPECT_EQ(message({1, 1, 1, 1, 0}), "physics.diffusion.frame_ms: found 0, expected a finite number > 0 ms");
  EXPECT_EQ(message({1, 1, 100, 1e-6, 1}),
            "physics.diffusion.step_ms: found 1e-06 ms, expected at least a millionth of end_ms, 100 ms");
  EXPECT_EQ(message({2, 1, 1, 1, 1}),
            "physics.diffusion.from: found 2, expected a label of the mesh: 1, 7, 300");
  EXPECT_EQ(message({0, 1, 1, 1, 1}),
            "physics.diffusion.from: found 0, expected a label of the mesh: 1, 7, 300");
}

}  // namespace
}  // namespace voxtet
