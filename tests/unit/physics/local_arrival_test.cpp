#include "physics/eikonal/local_arrival.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/test_random.h"

namespace voxtet {
namespace {

using eikonal::local_arrival;
using eikonal::SquaredEdgeTimes;
using Corners = std::array<Eigen::Vector3d, 4>;

constexpr double kNotReached = std::numeric_limits<double>::infinity();

/// A speed of 1 mm/ms: times are distances.
SquaredEdgeTimes edges_of(const Corners& p) {
  return {(p[1] - p[0]).squaredNorm(), (p[2] - p[0]).squaredNorm(), (p[3] - p[0]).squaredNorm(),
          (p[2] - p[1]).squaredNorm(), (p[3] - p[1]).squaredNorm(), (p[3] - p[2]).squaredNorm()};
}

/// The least value of a convex function on 0 to 1, by thirds.
template <class Function>
double least_on_unit(const Function& f) {
  double low = 0, high = 1;
  for (int i = 0; i < 80; ++i) {
    const double third = (high - low) / 3;
    if (f(low + third) < f(high - third))
      high -= third;
    else
      low += third;
  }
  return std::min({f(0), f(1), f((low + high) / 2)});
}

/// The arrival at point 0, by search over the whole face.
double searched_arrival(const Corners& p, const std::array<double, 4>& times) {
  return least_on_unit([&](double u) {
    return least_on_unit([&](double v) {
      const Eigen::Vector3d m((1 - u) * (1 - v), (1 - u) * v, u);
      const Eigen::Vector3d y = m[0] * p[1] + m[1] * p[2] + m[2] * p[3];
      return m.dot(Eigen::Vector3d(times[1], times[2], times[3])) + (p[0] - y).norm();
    });
  });
}

TEST(LocalArrival, APlaneWaveThroughTheFaceArrivesWithTheSpeedOfTheTissue) {
  const Corners p{{{0.2, 0.3, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Eigen::Vector3d direction = Eigen::Vector3d(0.1, -0.05, 1).normalized();
  std::array<double, 4> times{};
  for (std::size_t i = 1; i < 4; ++i) times[i] = 5 + direction.dot(p[i]);
  EXPECT_NEAR(local_arrival(edges_of(p), 0, times), 5 + direction.dot(p[0]), 1e-14);
}

TEST(LocalArrival, IsTheSameWhicheverCornerIsAsked) {
  const Corners p{{{0.2, 0.3, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const std::array<double, 4> times{0, 0.3, 0.1, 0.4};
  const double expected = local_arrival(edges_of(p), 0, times);
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    Corners moved;
    std::array<double, 4> moved_times{};
    for (std::size_t i = 0; i < 4; ++i) {
      moved[order[i]] = p[i];
      moved_times[order[i]] = times[i];
    }
    EXPECT_NEAR(local_arrival(edges_of(moved), order[0], moved_times), expected, 1e-14);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(LocalArrival, WhereNoWaveHasReachedACornerItComesAlongTheOthers) {
  const Corners p{{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_NEAR(local_arrival(edges_of(p), 0, {0, 2, kNotReached, kNotReached}), 3, 1e-14);
  EXPECT_NEAR(local_arrival(edges_of(p), 0, {0, kNotReached, 2, kNotReached}), 2 + std::sqrt(2), 1e-14);
  // At the same time at both ends of the edge from (1, 0, 0) to (0, 1, 0): from its middle.
  EXPECT_NEAR(local_arrival(edges_of(p), 0, {0, kNotReached, 2, 2}), 2 + std::sqrt(1.5), 1e-14);
  EXPECT_EQ(local_arrival(edges_of(p), 0, {0, kNotReached, kNotReached, kNotReached}), kNotReached);
}

TEST(LocalArrival, IsTheLeastOverTheFaceInTetrahedraOfAnyShape) {
  const std::uint64_t seed = 7;
  test::TestRandom random(seed);
  const auto number = [&] { return random.below(2001) / 1000.0 - 1; };
  for (int i = 0; i < 400; ++i) {
    Corners p;
    for (Eigen::Vector3d& point : p)
      for (double& x : point) x = number();
    // Every other one is flattened: a sliver down to a thousandth.
    const double flat = i % 2 == 0 ? 1 : std::pow(10, -(i % 4));
    for (Eigen::Vector3d& point : p) point[2] *= flat;
    std::array<double, 4> times{0, number(), number(), number()};
    EXPECT_NEAR(local_arrival(edges_of(p), 0, times), searched_arrival(p, times), 1e-8)
        << "seed " << seed << ", tetrahedron " << i;
  }
}

TEST(LocalArrival, AFlatTetrahedronCarriesWavesAlongItsEdges) {
  const Corners p{{{1, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_NEAR(local_arrival(edges_of(p), 0, {0, 0, 3, 3}), std::sqrt(2), 1e-14);
  EXPECT_NEAR(local_arrival(edges_of(p), 0, {0, 2, 1, 1}), 1 + std::sqrt(0.5), 1e-14);
  const Corners line{{{3, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
  EXPECT_NEAR(local_arrival(edges_of(line), 0, {0, 0, 1, 2}), 3, 1e-14);
}

}  // namespace
}  // namespace voxtet
